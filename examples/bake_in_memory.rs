//! A plan drawn in memory becomes a picture of its floor, without a file being written by the library.
//!
//! `cargo run --release --example bake_in_memory` saves it as `target/floor.png`.

use image::{Rgb, RgbImage};
use trodden::crowd::Simulation;
use trodden::look::{FloorResolver, Look};
use trodden::marks::{Footfalls, MarksOptions, Origin};
use trodden::motion::{Frame, Motion, People};
use trodden::patterns::PatternLibrary;
use trodden::plan::FloorPlan;
use trodden::stamps::{Stamper, TexelGrid};
use trodden::sums::FloorSums;
use trodden::walls::Walls;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A corridor of 12 x 3 m with a pillar, 10 cm to a pixel; 1 is floor.
    let floor = |x: u32, y: u32| (5..35).contains(&y) && !((55..62).contains(&x) && (16..23).contains(&y));
    let mask = (0..40).flat_map(|y| (0..120).map(move |x| u8::from(floor(x, y)))).collect();
    let plan = FloorPlan::from_mask(120, 40, 0.1, mask);
    let walls = Walls::trace(&plan, &Default::default());
    let routes = trodden::routes::find(&plan, &walls, &Default::default())?;
    let library = PatternLibrary::built_in();
    let people = People::new(1, Default::default());
    let mut crowd = Simulation::new(&plan, &walls, &routes, &people, &Default::default())?;
    let origins = Origin::of_arrivals(crowd.arrivals().iter().map(|arrival| arrival.from_outside), 200);
    let mut footfalls = Footfalls::new(&people, &walls, &library, &MarksOptions::default(), origins)?;
    let grid = TexelGrid::covering(plan.width_m(), plan.height_m(), 100.0)?;
    let (stamper, mut sums) = (Stamper::new(&library, grid, &Default::default())?, FloorSums::new(grid));
    let (mut frame, mut marks) = (Frame::default(), Vec::new());
    while crowd.next_frame(&mut frame)? {
        footfalls.push(&frame, &mut marks);
    }
    footfalls.finish(&mut marks);
    sums.add(&stamper, &walls, &marks);
    let look = FloorResolver::new(&sums, &walls, &Look::default(), crowd.arrivals().len() as u32)?;
    let texels = look.resolve(0, 0, grid.width as usize, grid.height as usize).base_color;
    let row = |y: u32| ((grid.height - 1 - y) * grid.width) as usize;
    RgbImage::from_fn(grid.width, grid.height, |x, y| Rgb(texels[row(y) + x as usize])).save("target/floor.png")?;
    Ok(())
}
