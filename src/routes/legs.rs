//! Legs of routes, and the distance fields that lead along them.

use std::sync::Arc;

use rayon::prelude::*;

use super::field::Field;
use super::ground::Ground;
use super::{Place, targets};
use crate::plan::FloorPlan;
use crate::progress::{Interrupted, Progress};

/// End of a leg: a place, and whether it is the route's goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LegEnd {
    pub(super) place: Place,
    pub(super) last: bool,
}

impl LegEnd {
    /// Cells of this end.
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

/// Cells and legs of a route, for the crowd.
#[derive(Clone, Debug)]
pub(crate) struct RouteLegs {
    /// Cells where people appear.
    pub(crate) start_cells: Vec<usize>,
    /// Cells of the goal.
    pub(crate) goal_cells: Vec<usize>,
    /// Legs to each via place, and to the goal.
    pub(crate) legs: Vec<Leg>,
}

/// A leg: the path from one place of a route to the next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    /// Index of the distance field to its end.
    pub(crate) field: usize,
    /// Index of the flow to its end; people of default life follow the field.
    pub(crate) flow: Option<usize>,
}

/// Distance fields of leg ends, each computed once.
pub(super) struct FieldStore<'p> {
    fields: Vec<(LegEnd, Arc<Field>)>,
    progress: &'p dyn Progress,
}

impl FieldStore<'_> {
    pub(super) fn new(progress: &dyn Progress) -> FieldStore<'_> {
        FieldStore { fields: Vec::new(), progress }
    }

    /// Gives up once the user wants the work to stop.
    pub(super) fn keep_on(&self) -> Result<(), Interrupted> {
        self.progress.keep_on()
    }

    /// The field to some cells, which is not kept.
    pub(super) fn measure(&self, ground: &Ground, goal: &[usize]) -> Result<Field, Interrupted> {
        Field::to(ground, goal, self.progress)
    }

    /// Computes the missing fields in parallel.
    pub(super) fn fill(
        &mut self,
        plan: &FloorPlan,
        ground: &Ground,
        wanted: impl Iterator<Item = LegEnd>,
    ) -> Result<(), Interrupted> {
        let mut missing: Vec<LegEnd> = Vec::new();
        for end in wanted {
            if !missing.contains(&end) && self.fields.iter().all(|f| f.0 != end) {
                missing.push(end);
            }
        }
        let make = |end: LegEnd| Ok((end, Arc::new(self.measure(ground, &end.cells(plan, ground))?)));
        let made: Vec<_> = missing.into_par_iter().map(make).collect::<Result<_, Interrupted>>()?;
        self.fields.extend(made);
        Ok(())
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

    pub(super) fn shared(&self, index: usize) -> Arc<Field> {
        self.fields[index].1.clone()
    }

    pub(super) fn into_fields(self) -> Vec<Arc<Field>> {
        self.fields.into_iter().map(|(_, field)| field).collect()
    }
}
