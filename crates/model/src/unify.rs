//! Unification of lifted effects (paper: two effects unify if a bijection of their objects makes them equal).

use std::collections::BTreeSet;

use crate::{LiftedAtom, Symbol, Term};

/// Every bijection of the parameters `0..types.len()` of one effect to those of another that extends `fixed`,
/// respects `compatible`, and maps the signed atoms `left` exactly onto `right`; as `map[left] = right`, in
/// lexicographic order, at most `limit` of them.
///
/// `fixed[i]` is the image of parameter `i` where the call's arguments prescribe it. Two effects with different
/// numbers of parameters or atoms have none. Backtracking: the cost is exponential only in the parameters that the
/// calls do not fix and the atoms do not tell apart.
pub fn effect_bijections(
    fixed: &[Option<u32>],
    compatible: impl Fn(u32, u32) -> bool,
    left: &[(bool, LiftedAtom)],
    right: &[(bool, LiftedAtom)],
    limit: usize,
) -> Vec<Vec<u32>> {
    let right_set: BTreeSet<(bool, LiftedAtom)> = right.iter().cloned().collect();
    let left_set: BTreeSet<&(bool, LiftedAtom)> = left.iter().collect();
    if left_set.len() != right_set.len() {
        return Vec::new();
    }
    // An atom is checked as soon as its last parameter is mapped.
    let mut due: Vec<Vec<&(bool, LiftedAtom)>> = vec![Vec::new(); fixed.len() + 1];
    for signed in left_set {
        let last = signed.1.params().max().map_or(0, |p| p as usize + 1);
        due[last].push(signed);
    }
    let mut search = Search {
        fixed,
        compatible,
        due,
        right: right_set,
        map: Vec::new(),
        used: vec![false; fixed.len()],
        found: Vec::new(),
        limit,
    };
    if search.fits(0) {
        search.extend();
    }
    search.found
}

struct Search<'a, F> {
    fixed: &'a [Option<u32>],
    compatible: F,
    due: Vec<Vec<&'a (bool, LiftedAtom)>>,
    right: BTreeSet<(bool, LiftedAtom)>,
    map: Vec<u32>,
    used: Vec<bool>,
    found: Vec<Vec<u32>>,
    limit: usize,
}

impl<F: Fn(u32, u32) -> bool> Search<'_, F> {
    fn fits(&self, mapped: usize) -> bool {
        self.due[mapped].iter().all(|(sign, atom)| self.right.contains(&(*sign, atom.renamed(&self.map))))
    }

    fn extend(&mut self) {
        let at = self.map.len();
        if at == self.fixed.len() {
            self.found.push(self.map.clone());
            return;
        }
        for image in 0..self.fixed.len() as u32 {
            if self.found.len() >= self.limit {
                return;
            }
            let allowed = self.fixed[at].is_none_or(|prescribed| prescribed == image);
            if !allowed || self.used[image as usize] || !(self.compatible)(at as u32, image) {
                continue;
            }
            self.map.push(image);
            self.used[image as usize] = true;
            if self.fits(at + 1) {
                self.extend();
            }
            self.used[image as usize] = false;
            self.map.pop();
        }
    }
}

/// Whether `map` is a bijection of `0..map.len()` to itself.
pub fn is_bijection(map: &[u32]) -> bool {
    let mut seen = vec![false; map.len()];
    map.iter().all(|&i| seen.get_mut(i as usize).is_some_and(|s| !std::mem::replace(s, true)))
}

impl LiftedAtom {
    /// The atom over parameters that `atom` becomes when each entity is replaced by its index in `objects`; `None`
    /// if one is missing there.
    pub fn lift(atom: &crate::GroundAtom, index_of: impl Fn(&Symbol) -> Option<u32>) -> Option<Self> {
        let args = atom.args.iter().map(|arg| index_of(arg).map(Term::Param)).collect::<Option<_>>()?;
        Some(Self { predicate: atom.predicate.clone(), args })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn atoms(texts: &[&str]) -> Vec<(bool, LiftedAtom)> {
        texts.iter().map(|t| (true, LiftedAtom::parse(t).expect("an atom"))).collect()
    }

    #[test]
    fn every_bijection_is_found_in_order() {
        let left = atoms(&["hot(?0)", "hot(?1)"]);
        let all = effect_bijections(&[None, None], |_, _| true, &left, &left, 10);
        assert_eq!(all, [[0, 1], [1, 0]]);
        let fixed = effect_bijections(&[Some(1), None], |_, _| true, &left, &left, 10);
        assert_eq!(fixed, [[1, 0]]);
    }

    #[test]
    fn direction_and_sign_matter() {
        let on = atoms(&["on(?0,?1)"]);
        let under = atoms(&["on(?1,?0)"]);
        assert_eq!(effect_bijections(&[None, None], |_, _| true, &on, &under, 10), [[1, 0]]);
        let off: Vec<_> = on.iter().map(|(_, a)| (false, a.clone())).collect();
        assert!(effect_bijections(&[None, None], |_, _| true, &on, &off, 10).is_empty());
    }
}
