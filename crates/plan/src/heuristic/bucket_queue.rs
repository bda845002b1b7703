//! A priority queue for small numbers: a bucket each, and a heap for the large ones.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

const BUCKETS: usize = 1 << 12;

/// Takes items out smallest key first. A key put in may not be smaller than the one taken out last.
#[derive(Debug, Default)]
pub(crate) struct BucketQueue {
    buckets: Vec<Vec<u32>>,
    next: usize,
    large: BinaryHeap<Reverse<(u32, u32)>>,
}

impl BucketQueue {
    pub(crate) fn clear(&mut self) {
        for bucket in &mut self.buckets[self.next.min(BUCKETS)..] {
            bucket.clear();
        }
        self.large.clear();
        self.next = 0;
    }

    pub(crate) fn push(&mut self, key: u32, item: u32) {
        if key as usize >= BUCKETS {
            self.large.push(Reverse((key, item)));
            return;
        }
        if self.buckets.len() <= key as usize {
            self.buckets.resize_with(key as usize + 1, Vec::new);
        }
        self.buckets[key as usize].push(item);
    }

    pub(crate) fn pop(&mut self) -> Option<(u32, u32)> {
        while let Some(bucket) = self.buckets.get_mut(self.next) {
            if let Some(item) = bucket.pop() {
                return Some((self.next as u32, item));
            }
            self.next += 1;
        }
        self.large.pop().map(|Reverse(found)| found)
    }
}
