use trodden::math::vec2;

use super::sheet::{FLOOR, NOTE, Sheet, WALL};

/// Corridor between these.
const CORRIDOR: [f64; 2] = [12.4, 15.6];
/// Rooms north of the corridor end here; those south of it begin at [`SOUTH`].
const NORTH: f64 = 23.6;
const SOUTH: f64 = 4.4;
/// Thickness of the walls between rooms, and between rooms and corridor.
const PARTITION: f64 = 0.2;

/// A floor of a school, 66 x 28 m: one corridor, classrooms with two doors each on both sides, an entrance hall,
/// stairs at both ends, toilets, a staff room. The white round the building is the yard.
pub fn draw() -> Sheet {
    let mut sheet = Sheet::new(66.0, 28.0, 0.05, FLOOR);
    // The shell, and everything in it still solid.
    sheet.rect(WALL, [2.0, SOUTH - 0.4], [64.4, NORTH + 0.4]);
    sheet.rect(FLOOR, [2.4, CORRIDOR[0]], [64.0, CORRIDOR[1]]);
    // The corridor goes on into the next wing.
    sheet.rect(WALL, [64.0, CORRIDOR[0] - 0.4], [66.0, CORRIDOR[1] + 0.4]);
    sheet.rect(FLOOR, [64.0, CORRIDOR[0]], [66.0, CORRIDOR[1]]);
    for x in [9.0, 18.2, 36.6, 45.8] {
        classroom(&mut sheet, x, 9.0, true);
    }
    for x in [9.0, 18.2, 45.8] {
        classroom(&mut sheet, x, 9.0, false);
    }
    staff_room(&mut sheet, 27.4, 9.0);
    entrance(&mut sheet, 27.4, 9.0);
    toilets(&mut sheet, 36.6, 9.0);
    for x in [2.4, 55.0] {
        stairs(&mut sheet, x);
    }
    storage(&mut sheet);
    sheet
}

/// A room with desks, and a door at either end of its corridor wall.
fn classroom(sheet: &mut Sheet, x: f64, width: f64, north: bool) {
    room(sheet, x, width, north);
    for door in [x + 0.5, x + width - 1.5] {
        doorway(sheet, door, 1.0, north);
    }
    for row in 0..3 {
        for column in 0..4 {
            let (dx, dy) = (1.2 + 1.9 * f64::from(column), 2.2 + 1.8 * f64::from(row));
            let y = if north { CORRIDOR[1] + dy } else { CORRIDOR[0] - dy - 0.5 };
            sheet.rect(NOTE, [x + dx, y], [x + dx + 1.2, y + 0.5]);
        }
    }
}

/// A closed white room north or south of the corridor.
fn room(sheet: &mut Sheet, x: f64, width: f64, north: bool) {
    let (low, high) = if north { (CORRIDOR[1] + PARTITION, NORTH) } else { (SOUTH, CORRIDOR[0] - PARTITION) };
    sheet.rect(FLOOR, [x, low], [x + width, high]);
}

/// A gap in the corridor wall with a door that opens into the room.
fn doorway(sheet: &mut Sheet, x: f64, width: f64, north: bool) {
    if north {
        sheet.rect(FLOOR, [x, CORRIDOR[1]], [x + width, CORRIDOR[1] + PARTITION]);
        sheet.door(vec2(x, CORRIDOR[1] + PARTITION), vec2(x + width, CORRIDOR[1] + PARTITION));
    } else {
        sheet.rect(FLOOR, [x, CORRIDOR[0] - PARTITION], [x + width, CORRIDOR[0]]);
        sheet.door(vec2(x + width, CORRIDOR[0] - PARTITION), vec2(x, CORRIDOR[0] - PARTITION));
    }
}

/// One wide door, tables pushed together.
fn staff_room(sheet: &mut Sheet, x: f64, width: f64) {
    room(sheet, x, width, true);
    doorway(sheet, x + 3.9, 1.2, true);
    sheet.rect(NOTE, [x + 1.5, 19.0], [x + 3.9, 22.0]);
    sheet.rect(NOTE, [x + 5.1, 19.0], [x + 7.5, 22.0]);
}

/// A hall open to the corridor, a porch that runs to the image's side, shoe lockers.
fn entrance(sheet: &mut Sheet, x: f64, width: f64) {
    sheet.rect(FLOOR, [x, SOUTH], [x + width, CORRIDOR[0]]);
    let (left, right) = (x + 2.5, x + width - 2.5);
    sheet.rect(WALL, [left - 0.4, 0.0], [right + 0.4, SOUTH]);
    sheet.rect(FLOOR, [left, 0.0], [right, SOUTH]);
    // Doors: a middle post between two pairs of leaves.
    sheet.rect(WALL, [x + width / 2.0 - 0.1, SOUTH - 0.4], [x + width / 2.0 + 0.1, SOUTH]);
    for locker in [x + 1.2, x + width - 1.6] {
        sheet.rect(WALL, [locker, 6.2], [locker + 0.4, 10.2]);
    }
}

/// Two rooms with a door of 0.9 m each and cubicles along the outer wall.
fn toilets(sheet: &mut Sheet, x: f64, width: f64) {
    room(sheet, x, width, false);
    let middle = x + width / 2.0;
    sheet.rect(WALL, [middle - 0.1, SOUTH], [middle + 0.1, CORRIDOR[0]]);
    doorway(sheet, middle - 1.6, 0.9, false);
    doorway(sheet, middle + 0.7, 0.9, false);
    for start in [x, middle + 0.1] {
        for cubicle in 0..4 {
            let at = start + 1.1 * f64::from(cubicle);
            if cubicle > 0 {
                sheet.rect(WALL, [at - 0.05, SOUTH], [at + 0.05, SOUTH + 1.6]);
            }
            sheet.rect(NOTE, [at + 0.35, SOUTH + 0.1], [at + 0.75, SOUTH + 0.7]);
        }
        // Basins.
        sheet.rect(NOTE, [start, SOUTH + 3.0], [start + 0.5, SOUTH + 6.4]);
    }
}

/// A stairwell north of the corridor, as wide as two flights, without a door.
fn stairs(sheet: &mut Sheet, x: f64) {
    let width = 6.4;
    sheet.rect(FLOOR, [x, CORRIDOR[1]], [x + width, NORTH]);
    sheet.rect(WALL, [x + width / 2.0 - 0.1, 18.4], [x + width / 2.0 + 0.1, 22.0]);
    sheet.treads([x, 18.4], [x + width / 2.0 - 0.1, 22.0], false);
    sheet.treads([x + width / 2.0 + 0.1, 18.4], [x + width, 22.0], false);
}

/// What is left over: a store at the west end, a music room at the east end.
fn storage(sheet: &mut Sheet) {
    room(sheet, 2.4, 6.4, false);
    doorway(sheet, 6.6, 0.9, false);
    for shelf in [5.4, 7.2, 9.0] {
        sheet.rect(WALL, [2.4, shelf], [6.0, shelf + 0.4]);
    }
    room(sheet, 55.0, 9.0, false);
    doorway(sheet, 55.5, 1.2, false);
    sheet.disc(NOTE, vec2(60.6, 7.6), 1.1);
    // The rest of the north side is a plant room that nobody can enter.
    sheet.rect(FLOOR, [61.6, CORRIDOR[1] + PARTITION], [64.0, NORTH]);
}
