//! What is written opens right in the programs that read it, and mistakes are told before the work.

mod diff;
mod early;
mod layout;
mod scripts;
mod streams;
