//! Principal components do not depend on who is near whom; the Laplacian lives on it.

use super::*;

/// The root of the mean square error of rebuilding a crowd with so many numbers a moment, as a share of its motion, and how
/// many neighbours people have.
fn error_share(crowd: &Ensemble, method: Method, numbers: usize, neighbour_distance_m: f64) -> (f64, f64) {
    let features = Features::find(crowd, &FeaturesOptions { method, neighbour_distance_m }, &Silent).unwrap();
    // A component of the Laplacian is two numbers a moment.
    let components = if method == Method::Pca { numbers } else { numbers / 2 };
    let share = features.rebuild_error_m(components) / features.rebuild_error_m(0);
    (share, features.mean_neighbours().unwrap_or(f64::NAN))
}

/// Prints the comparison that the documentation quotes: `cargo test --lib few_neighbours -- --nocapture`.
#[test]
fn with_few_neighbours_principal_components_are_stabler() {
    const NUMBERS: usize = 4;
    for (name, crowd) in [("sideways", sideways(24)), ("to the centre", to_the_centre(24))] {
        let (pca, _) = error_share(&crowd, Method::Pca, NUMBERS, 2.0);
        println!("{name}: principal components leave {:.1} % with {NUMBERS} numbers a moment", 100.0 * pca);
        assert!(pca < 0.05, "{name}");
        let mut few: f64 = 0.0;
        let mut many: f64 = 1.0;
        for distance_m in [0.8, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0] {
            let (laplacian, neighbours) = error_share(&crowd, Method::Laplacian, NUMBERS, distance_m);
            println!("  Laplacian {distance_m:.1} m, {neighbours:>4.1} neighbours: {:>5.1} %", 100.0 * laplacian);
            assert!(laplacian >= pca - 1e-9, "no basis does better with as many numbers");
            // The same crowd decomposed with another idea of neighbours: principal components know none.
            assert_eq!(error_share(&crowd, Method::Pca, NUMBERS, distance_m).0, pca);
            if neighbours < 3.0 { few = few.max(laplacian) } else { many = many.min(laplacian) }
        }
        assert!(few > 0.9, "{name}: where few are near each other, the Laplacian says little of the motion, {few}");
        assert!(many < 0.4, "{name}: with more neighbours it says more, {many}");
    }
}
