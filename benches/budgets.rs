//! What large inputs may cost: processor time and peak memory of whole runs of the program, which fail above their budget by
//! half.
//!
//! The budgets are what was measured on two cores of an AMD EPYC under Linux, rustc 1.95. Other machines need other seconds;
//! `BUDGETS_TIMES=2 cargo bench --bench budgets` doubles them. Memory is the same everywhere.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, ExitCode, Stdio};
use std::thread::sleep;
use std::time::Duration;

use image::{GrayImage, Luma};

/// A run and its budget.
struct Case {
    name: &'static str,
    /// Writes the inputs `plan.toml` and what it names.
    inputs: fn(&Path),
    cpu_s: f64,
    memory_mib: f64,
}

const CASES: [Case; 6] = [
    Case { name: "floor of 60 x 40 m, 1000 people", inputs: building, cpu_s: 10.0, memory_mib: 470.0 },
    Case { name: "site of 200 m", inputs: |folder| site(folder, 2000, 0.1, 20), cpu_s: 14.0, memory_mib: 480.0 },
    Case { name: "site of 500 m", inputs: |folder| site(folder, 2500, 0.2, 10), cpu_s: 36.0, memory_mib: 880.0 },
    Case { name: "100 000 walls", inputs: pillars, cpu_s: 22.0, memory_mib: 295.0 },
    Case { name: "200 routes", inputs: routes, cpu_s: 15.5, memory_mib: 390.0 },
    Case { name: "recording of a million rows", inputs: recording, cpu_s: 1.5, memory_mib: 130.0 },
];

/// Draws a plan, and writes a scenario that begins with it.
fn plan(folder: &Path, px: [u32; 2], metres_per_pixel: f64, is_wall: impl Fn(u32, u32) -> bool, rest: &str) {
    let picture = GrayImage::from_fn(px[0], px[1], |x, y| Luma([if is_wall(x, y) { 0 } else { 255 }]));
    picture.save(folder.join("plan.png")).expect("the folder is writable");
    let head = format!("[plan]\nimage = \"plan.png\"\nmetres_per_pixel = {metres_per_pixel}\n");
    fs::write(folder.join("plan.toml"), head + rest).expect("the folder is writable");
}

/// Rooms of 100 x 100 px with walls 2 px thick and a door of 14 px in each.
fn rooms(px: [u32; 2]) -> impl Fn(u32, u32) -> bool {
    move |x, y| {
        let is_door = |along: u32| (43..57).contains(&(along % 100));
        let is_rim = x < 2 || y < 2 || x + 2 >= px[0] || y + 2 >= px[1];
        (x % 100 < 2 && !is_door(y)) || (y % 100 < 2 && !is_door(x)) || (is_rim && !(x < 2 && is_door(y) && y < 100))
    }
}

fn building(folder: &Path) {
    plan(folder, [600, 400], 0.1, rooms([600, 400]), "[crowd]\npeople = 1000\n");
}

fn site(folder: &Path, side_px: u32, metres_per_pixel: f64, texels: u32) {
    let rest = format!("[texture]\nfloor_texels_per_metre = {texels}\n[crowd]\npeople = 1000\n");
    plan(folder, [side_px; 2], metres_per_pixel, rooms([side_px; 2]), &rest);
}

/// Pillars of 0.4 m in a hall of 190 m, four walls each.
fn pillars(folder: &Path) {
    let side = 158 * 12;
    let is_wall = |x: u32, y: u32| {
        let is_rim = x < 2 || y < 2 || x + 2 >= side || y + 2 >= side;
        (is_rim && !(800..1000).contains(&y)) || ((4..8).contains(&(x % 12)) && (4..8).contains(&(y % 12)))
    };
    plan(folder, [side; 2], 0.1, is_wall, "[texture]\nfloor_texels_per_metre = 10\n[crowd]\npeople = 100\n");
}

/// From 200 places of a hall to the one across.
fn routes(folder: &Path) {
    let mut rest = String::from("[texture]\nfloor_texels_per_metre = 20\n[crowd]\npeople = 1000\n");
    for k in 0..200 {
        let (x, y) = (2.0 + 2.8 * f64::from(k % 20), 2.0 + 3.6 * f64::from(k / 20));
        writeln!(rest, "[[route]]\nfrom = [{x:.1}, {y:.1}]\nto = [{:.1}, {:.1}]", 58.0 - x, 38.0 - y)
            .expect("a string");
    }
    let is_wall = |x: u32, y: u32| x < 5 || y < 5 || x >= 595 || y >= 395;
    plan(folder, [600, 400], 0.1, is_wall, &rest);
}

/// A thousand people who walk to and fro on lanes for 100 s, 10 frames a second.
fn recording(folder: &Path) {
    let mut rows = String::from("time,id,x,y\n");
    for frame in 0..1000 {
        for id in 0..1000 {
            let way = (f64::from(frame) * 0.13 + f64::from(id) * 7.7) % 100.0;
            let (x, y) = (5.0 + if way < 50.0 { way } else { 100.0 - way }, 2.0 + 0.036 * f64::from(id));
            writeln!(rows, "{:.1},{id},{x:.3},{y:.3}", f64::from(frame) * 0.1).expect("a string");
        }
    }
    fs::write(folder.join("paths.csv"), rows).expect("the folder is writable");
    let is_wall = |x: u32, y: u32| x < 5 || y < 5 || x >= 595 || y >= 395;
    let rest = "[texture]\nfloor_texels_per_metre = 20\n[motion]\nfile = \"paths.csv\"\n";
    plan(folder, [600, 400], 0.1, is_wall, rest);
}

/// Processor seconds in the program itself, and peak memory in MiB, once it has ended.
fn cost(child: &mut Child) -> Option<(f64, f64)> {
    let of = |file: &str| fs::read_to_string(format!("/proc/{}/{file}", child.id())).ok();
    let mut memory_kib = 0.0;
    // The memory of a process that has ended is gone; its time stays until it is waited for.
    while let Some(peak) =
        of("status")?.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse().ok())
    {
        memory_kib = peak;
        sleep(Duration::from_millis(2));
    }
    let stat = of("stat")?;
    let ticks: f64 = stat.rsplit(')').next()?.split_whitespace().nth(11)?.parse().ok()?;
    child.wait().ok()?.success().then_some((ticks / 100.0, memory_kib / 1024.0))
}

fn main() -> ExitCode {
    if !cfg!(target_os = "linux") {
        println!("budgets: /proc, which tells the memory, is of Linux");
        return ExitCode::SUCCESS;
    }
    let times: f64 = std::env::var("BUDGETS_TIMES").ok().and_then(|times| times.parse().ok()).unwrap_or(1.0);
    let mut status = ExitCode::SUCCESS;
    println!("{:32}  {:>9} {:>9}  {:>9} {:>9}", "run", "user s", "budget", "MiB", "budget");
    for case in &CASES {
        let folder = tempfile::tempdir().expect("there is room");
        (case.inputs)(folder.path());
        let mut command = Command::new(env!("CARGO_BIN_EXE_trodden"));
        command.args(["bake", "plan.toml", "-o", "out", "--floor-only", "--quiet", "--threads", "2"]);
        let mut child = command.current_dir(folder.path()).stdin(Stdio::null()).spawn().expect("the program starts");
        let Some((cpu_s, memory_mib)) = cost(&mut child) else {
            println!("{:32}  failed", case.name);
            status = ExitCode::FAILURE;
            continue;
        };
        let above = cpu_s > 1.5 * times * case.cpu_s || memory_mib > 1.5 * case.memory_mib;
        let verdict = if above { "  above its budget by half" } else { "" };
        println!(
            "{:32}  {cpu_s:9.1} {:9.1}  {memory_mib:9.0} {:9.0}{verdict}",
            case.name,
            case.cpu_s * times,
            case.memory_mib
        );
        if above {
            status = ExitCode::FAILURE;
        }
    }
    status
}
