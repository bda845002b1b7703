//! Many short lists in two allocations.

/// PackedLists of `T`, numbered from 0.
#[derive(Debug, Clone)]
pub(crate) struct PackedLists<T> {
    ends: Vec<u32>,
    items: Vec<T>,
}

impl<T> Default for PackedLists<T> {
    fn default() -> Self {
        Self { ends: Vec::new(), items: Vec::new() }
    }
}

impl<T: Copy> PackedLists<T> {
    /// Appends a list.
    pub(crate) fn push(&mut self, list: impl IntoIterator<Item = T>) {
        self.items.extend(list);
        self.ends.push(self.items.len() as u32);
    }

    /// The lists that pairs of a list's number and an item make, in the pairs' order.
    pub(crate) fn from_pairs(lists: usize, pairs: impl Iterator<Item = (u32, T)> + Clone) -> Self {
        let mut ends = vec![0_u32; lists];
        let mut first = None;
        for (list, item) in pairs.clone() {
            ends[list as usize] += 1;
            first.get_or_insert(item);
        }
        let mut total = 0;
        for end in &mut ends {
            total += std::mem::replace(end, total);
        }
        // Now each number is where its list begins; it moves to where it ends.
        let mut items = first.map_or_else(Vec::new, |item| vec![item; total as usize]);
        for (list, item) in pairs {
            let at = &mut ends[list as usize];
            items[*at as usize] = item;
            *at += 1;
        }
        Self { ends, items }
    }

    /// How many lists there are.
    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    /// Where the items of a list stand among all items.
    pub(crate) fn range(&self, list: usize) -> std::ops::Range<usize> {
        let start = if list == 0 { 0 } else { self.ends[list - 1] as usize };
        start..self.ends[list] as usize
    }

    /// The item at a place among all items.
    pub(crate) fn item(&self, place: usize) -> T {
        self.items[place]
    }

    /// One list.
    pub(crate) fn get(&self, list: usize) -> &[T] {
        &self.items[self.range(list)]
    }

    /// One list, to be brought into another order.
    pub(crate) fn get_mut(&mut self, list: usize) -> &mut [T] {
        let range = self.range(list);
        &mut self.items[range]
    }

    /// Every list.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[T]> + Clone {
        (0..self.len()).map(|list| self.get(list))
    }
}

impl PackedLists<u32> {
    /// For each number below `items`, the numbers of the lists that it is in.
    pub(crate) fn inverse(&self, items: usize) -> Self {
        let pairs = self.iter().zip(0..).flat_map(|(list, number)| list.iter().map(move |&item| (item, number)));
        Self::from_pairs(items, pairs)
    }
}
