use trodden::math::{Vec2, vec2};

use super::sheet::{FLOOR, NOTE, Sheet, WALL, direction};

/// Middle of the round hall.
const HALL: Vec2 = vec2(30.0, 23.0);
/// Inner radius of the round hall.
const HALL_RADIUS: f64 = 9.0;
/// Thickness of the outer walls.
const WALL_M: f64 = 0.5;
/// Direction of the long gallery.
const GALLERY_DEG: f64 = 24.0;
/// Where the curved gallery begins and ends, seen from the middle of the hall.
const GALLERY_ENDS_DEG: [f64; 2] = [112.0, 238.0];

/// A museum, 64 x 52 m, in a garden: a round hall with columns, a gallery set at an angle, a curved gallery round
/// the hall, a reading room with an apse. Nearly every wall is oblique or curved.
pub fn draw() -> Sheet {
    let mut sheet = Sheet::new(64.0, 52.0, 0.05, FLOOR);
    // All rooms as solids grown by the thickness of the walls, then all rooms hollow: walls are left between them
    // wherever two do not overlap.
    for (ink, grown) in [(WALL, WALL_M), (FLOOR, 0.0)] {
        sheet.disc(ink, HALL, HALL_RADIUS + grown);
        entrance(&mut sheet, ink, grown);
        long_gallery(&mut sheet, ink, grown);
        curved_gallery(&mut sheet, ink, grown);
        reading_room(&mut sheet, ink, grown);
        passages(&mut sheet, ink, grown);
    }
    exhibits(&mut sheet);
    sheet
}

/// From the south side of the image up to the hall.
fn entrance(sheet: &mut Sheet, ink: u8, grown: f64) {
    sheet.rect(ink, [26.5 - grown, 0.0], [33.5 + grown, 10.0 + grown]);
}

/// An oblique hall to the east, and the way out at its far end.
fn long_gallery(sheet: &mut Sheet, ink: u8, grown: f64) {
    let ahead = direction(GALLERY_DEG);
    sheet.turned_rect(ink, HALL + ahead * 20.5, [19.0 + 2.0 * grown, 10.0 + 2.0 * grown], GALLERY_DEG);
    sheet.rect(ink, [57.0, 30.0 - grown], [64.0, 34.0 + grown]);
}

/// A third of a ring round the hall.
fn curved_gallery(sheet: &mut Sheet, ink: u8, grown: f64) {
    let (inner, outer) = (13.0, 20.0);
    for degrees in GALLERY_ENDS_DEG {
        let ahead = direction(degrees);
        sheet.stroke(ink, HALL + ahead * (inner - grown), HALL + ahead * (outer + grown), 2.0 * grown);
    }
    sheet.ring(ink, HALL, [inner - grown, outer + grown], GALLERY_ENDS_DEG);
}

/// North of the hall: a rectangle that ends in half a circle.
fn reading_room(sheet: &mut Sheet, ink: u8, grown: f64) {
    sheet.rect(ink, [27.0 - grown, 34.0 - grown], [41.0 + grown, 42.0]);
    sheet.disc(ink, vec2(34.0, 42.0), 7.0 + grown);
}

/// Ways between the rooms.
fn passages(sheet: &mut Sheet, ink: u8, grown: f64) {
    // Entrance to hall, hall to reading room, reading room to curved gallery.
    sheet.rect(ink, [27.5 - grown, 9.5], [32.5 + grown, 16.0]);
    sheet.rect(ink, [29.0 - grown, 31.0], [32.0 + grown, 35.0]);
    sheet.rect(ink, [23.0, 37.0 - grown], [27.5, 38.4 + grown]);
    // Hall to long gallery, hall to both ends of the curved gallery.
    for (degrees, width, length) in [(GALLERY_DEG, 4.0, 12.0), (128.0, 2.4, 13.5), (222.0, 2.4, 13.5)] {
        let ahead = direction(degrees);
        sheet.stroke(ink, HALL + ahead * 8.0, HALL + ahead * length, width + 2.0 * grown);
    }
}

/// Columns, plinths, cases and shelves.
fn exhibits(sheet: &mut Sheet) {
    for column in 0..10 {
        sheet.disc(WALL, HALL + direction(18.0 + 36.0 * f64::from(column)) * 6.6, 0.4);
    }
    sheet.disc(WALL, HALL, 1.3);
    sheet.ring(NOTE, HALL, [1.9, 1.95], [0.0, 360.0]);
    // Cases in the long gallery, along and across it.
    let ahead = direction(GALLERY_DEG);
    for (along, across, turn) in
        [(14.5, 2.2, 0.0), (19.0, -2.0, 0.0), (23.5, 2.2, 90.0), (26.5, -1.8, 45.0), (15.5, -2.6, 90.0)]
    {
        let centre = HALL + ahead * along + ahead.left() * across;
        sheet.turned_rect(WALL, centre, [2.4, 0.9], GALLERY_DEG + turn);
    }
    // Short screens that stand out of the curved gallery's walls, in turn from the inner and the outer one.
    for (screen, degrees) in [140.0, 158.0, 176.0, 194.0, 210.0].into_iter().enumerate() {
        let ahead = direction(degrees);
        let (from, to) = if screen % 2 == 0 { (12.9, 15.6) } else { (17.4, 20.1) };
        sheet.stroke(WALL, HALL + ahead * from, HALL + ahead * to, 0.3);
    }
    // Shelves in the reading room: rows, and a fan in the apse.
    for row in 0..3 {
        let y = 36.2 + 2.2 * f64::from(row);
        sheet.rect(WALL, [35.0, y], [39.6, y + 0.5]);
    }
    for degrees in [20.0, 55.0, 90.0, 125.0, 160.0] {
        let ahead = direction(degrees);
        sheet.stroke(WALL, vec2(34.0, 42.0) + ahead * 3.6, vec2(34.0, 42.0) + ahead * 6.2, 0.5);
    }
    // The desk at the entrance.
    sheet.rect(WALL, [31.6, 3.6], [32.4, 6.4]);
}
