use trodden::math::vec2;

use super::sheet::{FLOOR, NOTE, Sheet, WALL};

/// A station concourse, 72 x 40 m: three entrances from the street, a hall with shops and ticket machines, a line
/// of ticket gates, an inner hall, and three flights of stairs down to the platforms.
pub fn draw() -> Sheet {
    let mut sheet = Sheet::new(72.0, 40.0, 0.05, WALL);
    outer_hall(&mut sheet);
    inner_hall(&mut sheet);
    gates(&mut sheet);
    pillars(&mut sheet);
    sheet
}

/// The hall on the street's side, y 6 to 20.
fn outer_hall(sheet: &mut Sheet) {
    sheet.rect(FLOOR, [6.0, 6.0], [66.0, 20.0]);
    // Entrances: two from the south, one from the west, with the notes of their steps.
    sheet.rect(FLOOR, [14.0, 0.0], [20.0, 6.0]);
    sheet.rect(FLOOR, [50.0, 0.0], [56.0, 6.0]);
    sheet.rect(FLOOR, [0.0, 10.0], [6.0, 15.0]);
    sheet.treads([14.0, 1.5], [20.0, 3.0], false);
    sheet.treads([50.0, 1.5], [56.0, 3.0], false);
    // Shops along the south wall: open fronts between short piers, shelves as notes.
    for shop in 0..4 {
        let (x, width) = (22.4 + 6.8 * f64::from(shop), 6.3);
        sheet.rect(FLOOR, [x, 0.6], [x + width, 5.7]);
        sheet.rect(FLOOR, [x + 1.2, 5.7], [x + width - 1.2, 6.0]);
        sheet.rect(NOTE, [x + 0.4, 1.0], [x + 1.0, 4.6]);
        sheet.rect(NOTE, [x + width - 1.0, 1.0], [x + width - 0.4, 4.6]);
    }
    // A bakery in the east with a counter.
    sheet.rect(FLOOR, [66.3, 7.0], [71.4, 14.0]);
    sheet.rect(FLOOR, [66.0, 8.5], [66.3, 12.5]);
    sheet.rect(WALL, [68.8, 8.0], [69.4, 13.0]);
    // Ticket machines along the north wall, a kiosk that stands free.
    for machine in 0..6 {
        let x = 8.5 + 1.6 * f64::from(machine);
        sheet.rect(WALL, [x, 19.2], [x + 1.0, 20.0]);
    }
    sheet.rect(WALL, [33.0, 9.0], [39.0, 12.0]);
    sheet.rect(FLOOR, [33.3, 9.3], [38.7, 11.7]);
}

/// The hall behind the gates, y 21.8 to 33.5, with stairs, toilets and a waiting room.
fn inner_hall(sheet: &mut Sheet) {
    sheet.rect(FLOOR, [6.0, 21.8], [66.0, 33.5]);
    for x in [11.0, 33.5, 57.0] {
        sheet.rect(FLOOR, [x, 33.5], [x + 5.0, 40.0]);
        sheet.treads([x, 34.5], [x + 5.0, 40.0], false);
        // The handrail in the middle of the flight.
        sheet.rect(WALL, [x + 2.45, 34.5], [x + 2.55, 38.4]);
    }
    // The waiting room: glass walls, two doors.
    sheet.rect(WALL, [20.0, 29.0], [30.0, 33.5]);
    sheet.rect(FLOOR, [20.15, 29.15], [29.85, 33.35]);
    sheet.rect(FLOOR, [21.5, 29.0], [22.7, 29.15]);
    sheet.rect(FLOOR, [27.3, 29.0], [28.5, 29.15]);
    for seat in 0..3 {
        let x = 23.4 + 1.1 * f64::from(seat);
        sheet.rect(NOTE, [x, 31.0], [x + 0.7, 32.6]);
    }
    // Toilets: lobby with two doors into closed rooms.
    sheet.rect(FLOOR, [43.0, 33.8], [53.0, 39.4]);
    sheet.rect(WALL, [47.9, 33.8], [48.1, 39.4]);
    for x in [45.0, 50.0] {
        sheet.rect(FLOOR, [x, 33.5], [x + 1.0, 33.8]);
        sheet.door(vec2(x, 33.8), vec2(x + 1.0, 33.8));
    }
    for x in [44.1, 45.3, 50.6, 51.8] {
        sheet.rect(WALL, [x, 37.6], [x + 0.1, 39.4]);
    }
}

/// The barrier between the halls: glass walls, two groups of gates, the booth between them. People go in through
/// the western group and out through the eastern one.
fn gates(sheet: &mut Sheet) {
    sheet.rect(WALL, [6.0, 20.0], [66.0, 21.8]);
    for group in [22.8, 39.3] {
        sheet.rect(FLOOR, [group, 19.9], [group + 9.9, 21.9]);
        // Cabinets of 0.3 m, aisles of 0.9 m; the first aisle is the wide one.
        for cabinet in 0..7 {
            let x = group + 1.5 + 1.2 * f64::from(cabinet);
            sheet.rect(WALL, [x, 20.0], [x + 0.3, 21.8]);
        }
    }
    // The booth: closed, white inside.
    sheet.rect(FLOOR, [33.0, 20.2], [39.0, 21.6]);
    // Glass is thin: rooms for machines behind it.
    sheet.rect(FLOOR, [6.3, 20.2], [22.5, 21.6]);
    sheet.rect(FLOOR, [49.5, 20.2], [65.7, 21.6]);
}

/// Two rows of round pillars in the outer hall, one of square ones in the inner hall.
fn pillars(sheet: &mut Sheet) {
    for column in 0..7 {
        let x = 9.0 + 9.0 * f64::from(column);
        for y in [8.5, 16.0] {
            if !(30.0..42.0).contains(&x) || y > 12.0 {
                sheet.disc(WALL, vec2(x, y), 0.45);
            }
        }
        sheet.rect(WALL, [x - 0.4, 26.1], [x + 0.4, 26.9]);
    }
}
