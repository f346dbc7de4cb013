use super::sheet::{FLOOR, Sheet, WALL};

/// A network of corridors, 80 m square, 5 m wide, that run out at the image's sides: figure and ground, all
/// walls along the axes.
///
/// ```text
///        |      |            |
///    ----+------+------------+----   y = 58
///        |      |            |
///        |      +----+       |
///        |           |       |
///    ----+-----------+-------+----   y = 22
///        |                   |
///       x = 18    x = 44    x = 66
/// ```
pub fn draw() -> Sheet {
    let mut sheet = Sheet::new(80.0, 80.0, 0.1, WALL);
    // Along x: the two through corridors.
    sheet.rect(FLOOR, [0.0, 19.5], [80.0, 24.5]);
    sheet.rect(FLOOR, [0.0, 55.5], [80.0, 60.5]);
    // Along y: through on both sides, and one between the two.
    sheet.rect(FLOOR, [15.5, 0.0], [20.5, 80.0]);
    sheet.rect(FLOOR, [63.5, 0.0], [68.5, 80.0]);
    sheet.rect(FLOOR, [41.5, 24.5], [46.5, 55.5]);
    // Niches that nobody walks through: lift lobbies and a bay with machines.
    sheet.rect(FLOOR, [29.0, 24.5], [34.0, 28.0]);
    sheet.rect(FLOOR, [52.0, 60.5], [57.0, 64.0]);
    sheet.rect(FLOOR, [68.5, 38.0], [71.5, 44.0]);
    sheet
}
