//! Drawings of few bytes that took minutes to read.

use std::fmt::Write as _;
use std::time::Instant;

use trodden::plan::{PlanOptions, read};

use super::Sandbox;

/// Each of many long lines side by side was compared with all others once for each metre of it.
#[test]
fn lines_of_kilometres_side_by_side_are_read() {
    let sandbox = Sandbox::new();
    let mut drawing = String::from("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
    for k in 0..1000 {
        let y = f64::from(k) * 0.0009;
        write!(drawing, "0\nLINE\n8\nWALL\n10\n0\n20\n{y}\n11\n3900\n21\n{y}\n").unwrap();
    }
    drawing.push_str("0\nENDSEC\n0\nEOF\n");
    let path = sandbox.write("plan.dxf", &drawing);
    let begun = Instant::now();
    assert!(read(&path, &PlanOptions::default()).is_ok());
    let seconds = begun.elapsed().as_secs_f64();
    assert!(seconds < 20.0, "it was read in {seconds} s");
}
