use trodden::math::vec2;

use super::sheet::{FLOOR, NOTE, Sheet, WALL};

/// A plaza, 30 x 24 m: house fronts with door niches around it, a street from each side, a fountain, four trees, benches.
pub fn draw() -> Sheet {
    let mut sheet = Sheet::new(30.0, 24.0, 0.05, WALL);
    sheet.rect(FLOOR, [1.5, 1.5], [28.5, 22.5]);
    // Streets: north and south in the middle, west and east set off from it.
    sheet.rect(FLOOR, [11.0, 22.5], [19.0, 24.0]);
    sheet.rect(FLOOR, [10.0, 0.0], [18.0, 1.5]);
    sheet.rect(FLOOR, [0.0, 12.0], [1.5, 17.0]);
    sheet.rect(FLOOR, [28.5, 6.0], [30.0, 11.0]);
    // Door niches in the fronts.
    for x in [4.0, 7.0, 21.5, 25.0] {
        sheet.rect(FLOOR, [x, 22.5], [x + 1.2, 22.9]);
        sheet.rect(FLOOR, [x, 1.1], [x + 1.2, 1.5]);
    }
    // Joints of the paving.
    for k in 1..9 {
        let x = 1.5 + 3.0 * f64::from(k);
        sheet.rect(NOTE, [x, 1.5], [x + 0.05, 22.5]);
    }
    fountain(&mut sheet);
    for (x, y) in [(9.0, 18.5), (21.0, 18.5), (9.5, 4.5), (21.5, 4.5)] {
        sheet.disc(WALL, vec2(x, y), 0.3);
        sheet.ring(NOTE, vec2(x, y), [0.95, 1.0], [0.0, 360.0]);
    }
    for y in [7.0, 9.6] {
        sheet.rect(NOTE, [2.2, y], [2.7, y + 1.8]);
    }
    sheet
}

/// A round basin with a rim to sit on.
fn fountain(sheet: &mut Sheet) {
    let middle = vec2(24.2, 14.5);
    sheet.disc(WALL, middle, 1.6);
    sheet.ring(NOTE, middle, [2.2, 2.25], [0.0, 360.0]);
}
