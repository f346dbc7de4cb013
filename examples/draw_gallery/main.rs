//! Draws a piece of a finished bake's floor in every material and preset, as `docs/gallery.md` shows it:
//!
//! ```text
//! cargo run --release --example draw_gallery -- BAKE OUT.jpg X,Y,SIDE PX
//! ```
//!
//! `X,Y` is the lower left corner of the piece and `SIDE` its side, metres; each piece is `PX` pixels wide. Or lays pictures of
//! one size side by side, three to a row:
//!
//! ```text
//! cargo run --release --example draw_gallery -- sheet OUT.jpg PICTURE...
//! ```

use std::path::Path;

use image::imageops::{FilterType, resize};
use image::{Rgb, RgbImage};
use trodden::export::{Manifest, read_sums};
use trodden::look::{FloorResolver, Look};
use trodden::math::vec2;

const MATERIALS: [&str; 10] =
    ["vinyl", "terrazzo", "wood", "carpet", "tile", "concrete", "stone", "dark", "asphalt", "paving"];
/// Columns: the preset, and whether the floor is clean.
const COLUMNS: [(&str, bool); 4] = [("commuters", true), ("commuters", false), ("heavy", false), ("wet", false)];
const GAP_PX: u32 = 6;
/// Pictures in a row of a sheet.
const ROW_OF: usize = 3;
/// Colour under walls.
const WALL: Rgb<u8> = Rgb([58, 57, 62]);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [word, out, pictures @ ..] = arguments.as_slice()
        && word == "sheet"
    {
        return sheet(out, pictures);
    }
    let [bake, out, place, px] = arguments.as_slice() else { return Err("usage: BAKE OUT.jpg X,Y,SIDE PX".into()) };
    let place = place.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>()?;
    let [x, y, side] = place.as_slice() else { return Err("the piece is X,Y,SIDE".into()) };
    let px: u32 = px.parse()?;
    let bake = Path::new(bake);
    let manifest = Manifest::read(bake)?;
    let (walls, sums) = (manifest.walls()?, read_sums(bake, &manifest)?);
    let texels_per_metre = sums.grid().texels_per_metre;
    let count = (side * texels_per_metre) as u32;
    let [i0, j0] = [x, y].map(|metres| (metres * texels_per_metre) as i64);
    let [width, height] = [COLUMNS.len(), MATERIALS.len()].map(|n| n as u32 * (px + GAP_PX) - GAP_PX);
    let mut sheet = RgbImage::from_pixel(width, height, Rgb([255; 3]));
    for (row, material) in MATERIALS.into_iter().enumerate() {
        for (column, (preset, clean)) in COLUMNS.into_iter().enumerate() {
            let text = format!("preset = \"{preset}\"\n[floor]\nmaterial = \"{material}\"");
            let look = Look::parse(&text, Path::new("gallery"))?;
            let look = if clean { look.clean() } else { look };
            let floor = FloorResolver::new(&sums, &walls, &look, manifest.people)?;
            let texels = floor.resolve(i0, j0, count as usize, count as usize);
            let piece = RgbImage::from_fn(count, count, |i, j| {
                let j = count - 1 - j;
                let metres = |first: i64, k: u32| (first as f64 + f64::from(k) + 0.5) / texels_per_metre;
                let is_floor = walls.is_inside(vec2(metres(i0, i), metres(j0, j)));
                texels.base_color.get((j * count + i) as usize).filter(|_| is_floor).map_or(WALL, |&colour| Rgb(colour))
            });
            let piece = if count == px { piece } else { resize(&piece, px, px, FilterType::Lanczos3) };
            let place = [column, row].map(|n| n as i64 * i64::from(px + GAP_PX));
            image::imageops::replace(&mut sheet, &piece, place[0], place[1]);
        }
    }
    sheet.save(out)?;
    Ok(())
}

fn sheet(out: &str, pictures: &[String]) -> Result<(), Box<dyn std::error::Error>> {
    let pictures =
        pictures.iter().map(|path| Ok(image::open(path)?.to_rgb8())).collect::<image::ImageResult<Vec<_>>>()?;
    let (width, height) = pictures.first().map_or((0, 0), |picture| picture.dimensions());
    let size = [ROW_OF, pictures.len().div_ceil(ROW_OF)];
    let [columns, rows] = size.map(|count| count as u32);
    let all = [columns * (width + GAP_PX) - GAP_PX, rows * (height + GAP_PX) - GAP_PX];
    let mut sheet = RgbImage::from_pixel(all[0], all[1], Rgb([255; 3]));
    for (n, picture) in pictures.iter().enumerate() {
        let place = [(n % ROW_OF) as u32 * (width + GAP_PX), (n / ROW_OF) as u32 * (height + GAP_PX)];
        image::imageops::replace(&mut sheet, picture, i64::from(place[0]), i64::from(place[1]));
    }
    sheet.save(out)?;
    Ok(())
}
