//! Conditions as disjunctions of cases, each a conjunction of literals over the block's variables and over variables of
//! its own.
//!
//! As in Helmert 2009 (Concise finite-domain representations for PDDL planning tasks, section 4), what is universally
//! quantified becomes a derived predicate. Beyond it, so does a disjunction inside of a conjunction if multiplying it
//! out would give too many cases: then the model grows with the length of the text only.

use std::collections::BTreeSet;

use typelift_model::{Literal, Wording};

use super::block::Block;
use super::error::CompileError;
use super::normal::Normal;

/// One way in which a condition can hold: there are objects for the variables of its own, such that these literals do.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Case {
    /// The variables of its own.
    pub(super) exists: Vec<u32>,
    /// The literals; equalities among them.
    pub(super) literals: Vec<Literal>,
}

impl Case {
    fn of(literal: Literal) -> Self {
        Self { exists: Vec::new(), literals: vec![literal] }
    }

    /// Both of two cases.
    fn and(&self, other: &Self) -> Self {
        Self {
            exists: [self.exists.as_slice(), &other.exists].concat(),
            literals: [self.literals.as_slice(), &other.literals].concat(),
        }
    }
}

impl Block<'_> {
    /// Not too many cases of which one holds if and only if the condition does.
    pub(super) fn few_cases(&mut self, condition: &Normal) -> Result<Vec<Case>, CompileError> {
        let cases = self.cases(condition)?;
        if cases.len() > self.world.limits.cases {
            Ok(self.as_one(condition.said(), &cases)?.into_iter().collect())
        } else {
            Ok(cases)
        }
    }

    /// Cases of which one holds if and only if the condition does. Their number is linear in that of its literals.
    pub(super) fn cases(&mut self, condition: &Normal) -> Result<Vec<Case>, CompileError> {
        match condition {
            Normal::Literal(literal) => Ok(vec![Case::of(literal.clone())]),
            Normal::Or(parts, _) => {
                let mut cases = Vec::with_capacity(parts.len());
                for part in parts {
                    cases.extend(self.cases(part)?);
                }
                Ok(cases)
            }
            Normal::And(parts) => self.conjunction(parts),
            Normal::Exists(variables, body, _) => {
                let mut cases = self.cases(body)?;
                for case in &mut cases {
                    case.exists.extend(variables);
                }
                Ok(cases)
            }
            Normal::Forall(..) => {
                let exception = condition.negated();
                let exceptions = self.cases(&exception)?;
                Ok(match self.invent("forall", exception.said(), &exceptions)? {
                    Some(atom) => vec![Case::of(Literal::negative(atom))],
                    None => vec![Case::default()],
                })
            }
        }
    }

    fn conjunction(&mut self, parts: &[Normal]) -> Result<Vec<Case>, CompileError> {
        let mut base = Case::default();
        let mut product: Vec<Case> = vec![Case::default()];
        for part in parts {
            let mut cases = self.cases(part)?;
            if cases.len() > 1 && product.len() * cases.len() > self.world.limits.cases {
                cases = self.as_one(part.said(), &cases)?.into_iter().collect();
            }
            match cases.as_slice() {
                [] => return Ok(Vec::new()),
                [only] => {
                    base.exists.extend(&only.exists);
                    base.literals.extend(only.literals.iter().cloned());
                }
                _ => product = product.iter().flat_map(|a| cases.iter().map(|b| a.and(b))).collect(),
            }
        }
        Ok(product.iter().map(|case| base.and(case)).collect())
    }

    /// A single case that holds if and only if one of these does; `None` if none ever can.
    fn as_one(&mut self, said: Option<&Wording>, cases: &[Case]) -> Result<Option<Case>, CompileError> {
        Ok(self.invent("or", said, cases)?.map(|atom| Case::of(Literal::positive(atom))))
    }

    /// The variables that cases mention and do not own, in order.
    pub(super) fn free_variables(cases: &[Case]) -> Vec<u32> {
        let mut free = BTreeSet::new();
        for case in cases {
            let mentioned = case.literals.iter().flat_map(|literal| literal.atom.params());
            free.extend(mentioned.filter(|variable| !case.exists.contains(variable)));
        }
        free.into_iter().collect()
    }
}
