use super::*;

/// A sheet with a plan of lines, or nothing, on a desk.
fn photograph(corners: [Point; 4], desk: [u8; 3], drawn: bool) -> DynamicImage {
    let map = homography(corners);
    let mut image = RgbImage::from_fn(900, 700, |x, y| {
        let grain = ((x * 7919 + y * 104_729) % 13) as u8;
        image::Rgb(desk.map(|v| v.saturating_add(grain)))
    });
    // Finely enough that every pixel of the sheet is met.
    for v in 0..2400 {
        for u in 0..2400 {
            let place = [(f64::from(u) + 0.5) / 2400.0, (f64::from(v) + 0.5) / 2400.0];
            let [x, y] = mapped(map, place);
            let is_ink =
                drawn && place.iter().all(|t| (0.1..0.9).contains(t)) && place.iter().any(|t| (t * 10.0) % 2.0 < 0.1);
            if x >= 0.0 && y >= 0.0 && x < 900.0 && y < 700.0 {
                let noise = ((u * 31 + v * 17) % 9) as u8;
                image.put_pixel(x as u32, y as u32, image::Rgb([if is_ink { 60 } else { 225 } + noise; 3]));
            }
        }
    }
    DynamicImage::ImageRgb8(image)
}

#[test]
fn corners_are_found_within_three_pixels() {
    for corners in [
        [[100.0, 80.0], [800.0, 60.0], [850.0, 640.0], [60.0, 610.0]],
        [[220.0, 60.0], [840.0, 200.0], [700.0, 660.0], [60.0, 520.0]],
        [[150.0, 150.0], [760.0, 140.0], [880.0, 650.0], [20.0, 660.0]],
    ] {
        for desk in [[40, 40, 44], [130, 90, 60], [150, 150, 150]] {
            let sheet = find(&photograph(corners, desk, true)).unwrap_or_else(|| panic!("{corners:?} on {desk:?}"));
            for (found, truth) in sheet.corners.iter().zip(corners) {
                assert!(distance(*found, truth) <= 3.0, "{found:?} for {truth:?} on {desk:?}");
            }
        }
    }
}

#[test]
fn the_aspect_ratio_follows_from_the_perspective() {
    // An A4 sheet of 297 x 210 before a camera of 900 x 700 pixels, tilted by 30 degrees.
    let camera = |x: f64, y: f64| {
        let (sine, cosine) = crate::math::sin_cos(0.52);
        let (y, z) = (y * cosine, 500.0 - y * sine);
        [450.0 + 900.0 * x / z, 350.0 + 900.0 * y / z]
    };
    let corners = [camera(-148.5, -105.0), camera(148.5, -105.0), camera(148.5, 105.0), camera(-148.5, 105.0)];
    let found = aspect(corners, [900.0, 700.0]);
    assert!((found - std::f64::consts::SQRT_2).abs() < 0.01, "{found}");
}

#[test]
fn drawings_are_no_photographs() {
    // A room in a black mass, a building on white, one on black; and an empty sheet.
    let room = |inside: u8, wall: u8| {
        let tone = |x: u32, y: u32| {
            let within = (100..800).contains(&x) && (80..620).contains(&y);
            let pillar = (400..440).contains(&x) && (80..500).contains(&y);
            image::Luma([if within && !pillar { inside } else { wall }])
        };
        DynamicImage::ImageLuma8(image::GrayImage::from_fn(900, 700, tone))
    };
    assert!(find(&room(255, 0)).is_none());
    assert!(find(&room(0, 255)).is_none());
    assert!(find(&room(255, 205)).is_none());
    let corners = [[100.0, 80.0], [800.0, 60.0], [850.0, 640.0], [60.0, 610.0]];
    assert!(find(&photograph(corners, [60; 3], false)).is_none());
}
