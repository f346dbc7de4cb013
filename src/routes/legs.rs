//! Legs of routes, and the distance fields that lead along them.

use std::sync::Arc;

use rayon::prelude::*;

use super::field::Field;
use super::ground::Ground;
use super::{Place, targets};
use crate::plan::FloorPlan;

/// A place that a leg leads to, and whether it is the route's last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LegEnd {
    pub(super) place: Place,
    pub(super) last: bool,
}

impl LegEnd {
    /// The cells that count as this end.
    pub(super) fn cells(self, plan: &FloorPlan, ground: &Ground) -> Vec<usize> {
        match self.last {
            true => targets::cells(plan, ground, self.place),
            false => targets::via_cells(plan, ground, self.place),
        }
    }
}

/// Ends of a route's legs, in order.
pub(super) fn leg_ends(via: impl Iterator<Item = Place>, goal: Place) -> impl Iterator<Item = LegEnd> {
    via.map(|place| LegEnd { place, last: false }).chain([LegEnd { place: goal, last: true }])
}

/// Distance fields of the ends of legs, each made once.
#[derive(Debug, Default)]
pub(super) struct FieldStore {
    fields: Vec<(LegEnd, Arc<Field>)>,
}

impl FieldStore {
    /// Makes the fields that are missing, in parallel.
    pub(super) fn fill(&mut self, plan: &FloorPlan, ground: &Ground, wanted: impl Iterator<Item = LegEnd>) {
        let mut missing: Vec<LegEnd> = Vec::new();
        for end in wanted {
            if !missing.contains(&end) && self.fields.iter().all(|f| f.0 != end) {
                missing.push(end);
            }
        }
        let made = missing.into_par_iter().map(|end| (end, Arc::new(Field::to(ground, &end.cells(plan, ground)))));
        let made: Vec<_> = made.collect();
        self.fields.extend(made);
    }

    pub(super) fn index(&self, end: LegEnd) -> usize {
        self.fields.iter().position(|f| f.0 == end).expect("filled with every leg before")
    }

    pub(super) fn get(&self, end: LegEnd) -> &Field {
        self.of_index(self.index(end))
    }

    pub(super) fn of_index(&self, index: usize) -> &Field {
        &self.fields[index].1
    }

    pub(super) fn into_fields(self) -> Vec<Arc<Field>> {
        self.fields.into_iter().map(|(_, field)| field).collect()
    }
}
