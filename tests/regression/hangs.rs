//! Ordinary plans of any size and scale end in reasonable time, with walls that do not cross.

mod drawings;
mod outlines;

use std::process::{Child, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use image::{GrayImage, Luma};
use trodden::math::SplitMix64;
use trodden::plan::FloorPlan;
use trodden::routes::{Navigation, RoutesError, RoutesOptions};
use trodden::walls::{Walls, WallsOptions};
use trodden::{Error, Interrupted, Progress, Stage};

use super::sandbox::Sandbox;

/// Asks the work to stop after a while, or after it has been asked so many times.
struct Deadline {
    at: Instant,
    asked: AtomicUsize,
    most_asked: usize,
}

impl Deadline {
    fn after(seconds: u64) -> Deadline {
        let at = Instant::now() + Duration::from_secs(seconds);
        Deadline { at, asked: AtomicUsize::new(0), most_asked: usize::MAX }
    }
}

impl Progress for Deadline {
    fn advance(&self, _: Stage, _: f64) {}
    fn warn(&self, _: &str) {}

    fn interrupted(&self) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed) >= self.most_asked || Instant::now() > self.at
    }
}

/// A corridor from west to east, 60 pixels long and three or more wide, with some dark pixels in it.
fn corridor(metres_per_pixel: f64, seed: u64) -> FloorPlan {
    let (width, height) = (60, 5);
    let mut random = SplitMix64::new(seed);
    let is_wall = |x: u32, y: u32, word: u64| {
        y == 0 || y == height - 1 || (seed > 0 && x > 0 && x < width - 1 && word.is_multiple_of(12))
    };
    let floor = (0..width * height).map(|k| u8::from(!is_wall(k % width, k / width, random.next_u64()))).collect();
    FloorPlan::from_mask(width, height, metres_per_pixel, floor)
}

/// Waits for a program that must end by itself.
fn ends_within(child: &mut Child, seconds: u64) -> bool {
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_secs(seconds) {
        if child.try_wait().unwrap().is_some() {
            return true;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().unwrap();
    false
}

/// Walking distances beyond 512 m were improved by less than they are rounded by, for ever.
#[test]
fn walking_farther_than_half_a_kilometre_ends() {
    let sandbox = Sandbox::new();
    let plan = GrayImage::from_fn(60, 4, |_, y| Luma([if y == 0 || y == 3 { 0 } else { 255 }]));
    plan.save(sandbox.path("plan.png")).unwrap();
    let mut command = sandbox.command(&["inspect", "plan.png", "--metres-per-pixel", "10"]);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    assert!(ends_within(&mut child, 60), "still looks for routes after a minute");
    assert!(child.wait().unwrap().success());
}

/// The same for any scale, with distances from none to more than half a kilometre.
#[test]
fn routes_are_found_at_any_scale() {
    for (seed, metres_per_pixel) in (0..).zip([0.01, 0.03, 0.1, 0.25, 0.5, 1.0, 2.0, 4.3, 7.0, 8.6, 9.3, 10.0]) {
        let plan = corridor(metres_per_pixel, seed);
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let found = Navigation::find_watched(&plan, &walls, &RoutesOptions::default(), &Deadline::after(60));
        match found.map(|(routes, _)| routes.len()) {
            Ok(count) => assert!(count > 0),
            Err(RoutesError::Interrupted(Interrupted)) => {
                panic!("endless at {metres_per_pixel} m per pixel, seed {seed}")
            }
            Err(error) => assert!(metres_per_pixel < 0.5 || seed > 0, "{error} at {metres_per_pixel}"),
        }
    }
}

/// While routes were looked for, Ctrl-C was not heard.
#[test]
fn looking_for_routes_can_be_interrupted() {
    let plan = corridor(1.0, 0);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let find = |most_asked: usize| {
        let progress = Deadline { most_asked, ..Deadline::after(60) };
        Navigation::find_watched(&plan, &walls, &RoutesOptions::default(), &progress).map(|_| ())
    };
    assert_eq!(find(0), Err(RoutesError::Interrupted(Interrupted)));
    // Within the first field, too.
    assert_eq!(find(100), Err(RoutesError::Interrupted(Interrupted)));
    assert_eq!(find(usize::MAX), Ok(()));
    assert!(matches!(Error::from(RoutesError::Interrupted(Interrupted)), Error::Interrupted(_)));
}

/// Walls seen from afar were looked up in thousands of blocks each that lie beyond their ends.
#[test]
fn walls_of_many_pillars_on_a_large_plan_are_baked() {
    let sandbox = Sandbox::new();
    // 400 x 400 m with 576 pillars of 2 m.
    let is_wall = |x: u32, y: u32| {
        let is_rim = !(2..=397).contains(&y) || (!(2..=397).contains(&x) && !(20..40).contains(&y));
        is_rim || (x % 16 < 2 && y % 16 < 2 && x > 8 && y > 8)
    };
    let plan = GrayImage::from_fn(400, 400, |x, y| Luma([if is_wall(x, y) { 0 } else { 255 }]));
    plan.save(sandbox.path("plan.png")).unwrap();
    let scenario = "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 1.0\n\
                    [texture]\nfloor_texels_per_metre = 1\nwall_texels_per_metre = 4\nlayers = false\n\
                    [crowd]\npeople = 1\n";
    sandbox.write("plan.toml", scenario);
    let mut command = sandbox.command(&["bake", "plan.toml", "-o", "out"]);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    assert!(ends_within(&mut child, 120), "still bakes after two minutes");
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    // The same pillars in a picture of one's own.
    let mut command = sandbox.command(&["view", "out", "--birds-eye", "--size", "320x240", "-o", "above.png"]);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    assert!(ends_within(&mut child, 120), "still draws after two minutes");
    assert!(child.wait().unwrap().success());
}
