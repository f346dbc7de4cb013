//! Ways to the stops of routes.

use std::sync::Arc;

use rayon::prelude::*;

use super::field::Field;
use super::flow::Flow;
use super::ground::Ground;
use super::legs::{FieldStore, RouteLegs};
use super::{Place, Route, RouteStop};
use crate::math::Rect;
use crate::progress::Interrupted;

/// How people come to a stop.
#[derive(Clone, Debug)]
pub(crate) struct StopWay {
    /// Walking distance to it.
    pub(crate) field: Arc<Field>,
    /// Flow that spreads people over the ways there; routes lead into rooms by themselves.
    pub(crate) flow: Option<Arc<Flow>>,
}

/// The ways to all stops of these routes, see [`Route::each_stop`].
pub(super) fn find(
    ground: &Ground,
    routes: &[Route],
    ways: &[RouteLegs],
    fields: &FieldStore<'_>,
) -> Result<Vec<StopWay>, Interrupted> {
    let way = |&(number, on_route): &(usize, &RouteStop)| {
        let into_room = on_route.after_via.checked_sub(1).filter(|_| !on_route.stop.spots.is_empty());
        if let Some(leg) = into_room {
            // Along the route to the room's middle.
            return Ok(StopWay { field: fields.shared(ways[number].legs[leg].field), flow: None });
        }
        let field = fields.measure(ground, &on_route.stop.cells(ground))?;
        let flow = Flow::new(ground, &starts(ground, routes, ways, &on_route.stop.name), &field);
        Ok(StopWay { field: Arc::new(field), flow: Some(Arc::new(flow)) })
    };
    Route::first_of_each_stop(routes).par_iter().map(way).collect()
}

/// Cells from which people come to a stop: of the place before it on each of its routes.
fn starts(ground: &Ground, routes: &[Route], ways: &[RouteLegs], name: &str) -> Vec<usize> {
    let mut cells = Vec::new();
    for (route, way) in routes.iter().zip(ways) {
        for on_route in route.stops.iter().filter(|on_route| on_route.stop.name == name) {
            let before = on_route.after_via.checked_sub(1).and_then(|via| route.via.get(via));
            match before.map(|via| via.place) {
                Some(Place::Area([min, max])) => cells.extend(ground.lattice.cells_within(Rect { min, max })),
                _ => cells.extend(&way.start_cells),
            }
        }
    }
    cells.retain(|&cell| ground.is_walkable(cell));
    cells.sort_unstable();
    cells.dedup();
    cells
}
