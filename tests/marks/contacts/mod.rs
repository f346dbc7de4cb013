//! What a crowd touches: where, how often, how high; measured on a corridor with doors, a narrow stretch and a turn.

mod computed;
mod heights;
mod places;
mod plans;
mod rates;
mod scene;
mod steps;
