//! What walls cost that nobody touches.

use std::process::Command;

use trodden::marks::Contact;
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan::FloorPlan;
use trodden::stamps::{StampOptions, WallGrid, WallStamper};
use trodden::sums::WallSums;
use trodden::walls::{Walls, WallsOptions};

/// What the process holds in memory right now; `None` where the system does not tell.
fn held_bytes() -> Option<usize> {
    let statm = std::fs::read_to_string("/proc/self/statm").ok()?;
    Some(statm.split_whitespace().nth(1)?.parse::<usize>().ok()? * 4096)
}

fn traced(side_px: usize, floor: impl Fn(usize, usize) -> bool) -> Walls {
    let amid = |k: usize| k > 0 && k < side_px - 1;
    let mask = (0..side_px * side_px).map(|k| (k % side_px, k / side_px));
    let mask = mask.map(|(x, y)| u8::from(amid(x) && amid(y) && floor(x, y))).collect();
    let plan = FloorPlan::from_mask(side_px as u32, side_px as u32, 0.1, mask);
    Walls::trace(&plan, &WallsOptions::default())
}

/// Some pattern of a hand: a square of a centimetre.
fn library() -> PatternLibrary {
    let mut library = PatternLibrary::built_in();
    let mut hand = library.patterns[0].clone();
    (hand.cause, hand.length_cm, hand.width_px, hand.height_px) = (Cause::Hand, 1.0, 10, 10);
    hand.coverage = vec![255; 100];
    library.patterns.insert(0, hand);
    library
}

fn touch(face: u32, along_m: f64) -> Contact {
    Contact {
        cause: Cause::Hand,
        face,
        along_m,
        height_m: 1.2,
        direction_rad: 0.5,
        pattern: 0,
        mirrored: false,
        length_m: 0.1,
        breadth_m: 0.1,
        strength: 0.3,
        variation: 7,
    }
}

/// Set for the process that has the test to itself.
const ALONE: &str = "TRODDEN_TEST_ALONE";

/// In a process of its own: what it holds in memory would count the tests beside it.
#[test]
fn walls_cost_where_they_are_touched() {
    if std::env::var_os(ALONE).is_some() {
        ten_kilometres();
        a_hundred_thousand_pillars();
        return;
    }
    // Without the name of the program, as tests are named.
    let (_, module) = module_path!().split_once("::").unwrap();
    let name = format!("{module}::walls_cost_where_they_are_touched");
    let mut alone = Command::new(std::env::current_exe().unwrap());
    let output = alone.args(["--exact", &name, "--nocapture"]).env(ALONE, "").output().unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && told.contains("1 passed"), "{told}{}", String::from_utf8_lossy(&output.stderr));
}

fn ten_kilometres() {
    let library = library();
    for density in [200.0, 1000.0] {
        let before = held_bytes();
        // Shelves of 2 x 100 m in a hall.
        let walls = traced(1000, |x, y| !(20..980).contains(&x) || y % 20 > 1 || y < 20);
        let metres: f64 = walls.faces.iter().map(|face| face.length_m()).sum();
        assert!(metres > 9_500.0, "{metres} m");
        let grid = WallGrid::covering(&walls, 2.6, density).unwrap();
        let mut sums = WallSums::new(grid.clone());
        let stamper = WallStamper::new(&library, &grid, &StampOptions::default()).unwrap();
        let held = before.zip(held_bytes()).map_or(0, |(before, now)| now.saturating_sub(before));
        println!("{metres:.0} m of walls at {density} texels/m: {:.1} MiB", held as f64 / 1_048_576.0);
        assert!(held < 50 << 20, "{held} bytes for {metres} m");
        assert_eq!(sums.bytes(), 0);
        sums.add(&stamper, &[touch(3, 5.0)]);
        assert!(sums.bytes() > 0 && sums.bytes() <= 9 * 32_768, "a touch costs its blocks: {}", sums.bytes());
    }
}

fn a_hundred_thousand_pillars() {
    let walls = traced(651, |x, y| x % 2 == 0 || y % 2 == 0);
    assert!(walls.faces.len() > 100_000, "{}", walls.faces.len());
    let grid = WallGrid::covering(&walls, 2.6, 200.0).unwrap();
    let stamper = WallStamper::new(&library(), &grid, &StampOptions::default()).unwrap();
    let mut sums = WallSums::new(grid);
    // Face 0 is the hall's own wall.
    let contacts: Vec<Contact> = (1..=500).map(|k| touch(k * 200, 0.1 * f64::from(k % 4))).collect();
    sums.add(&stamper, &contacts);
    assert!(sums.bytes() <= 2 * 500 * 32_768);
    let mut values = vec![0; 80 * 520];
    for contact in &contacts {
        sums.read(Cause::Hand, contact.face as usize, 0, 0, 80, 520, &mut values);
        assert!(values.iter().any(|&value| value > 0), "{contact:?}");
        // The next is another pillar.
        sums.read(Cause::Hand, contact.face as usize + 1, 0, 0, 80, 520, &mut values);
        assert!(values.iter().all(|&value| value == 0));
    }
}
