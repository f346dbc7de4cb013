//! Optical density of every pixel against the clean wall.

use rayon::prelude::*;

use super::photo::Photo;
use super::raster::PixelRaster;
use super::stain::StainMask;
use super::surface::WallSurface;

/// Optical density of each pixel of a photograph, mean over the channels, positive on the stain.
///
/// A stain of density D darkens channel c by D d_c, with mean(d) = 1 and noise of variance s_c^2. The least-squares
/// estimate of D from the measured D_c is sum(w_c D_c) with w_c = d_c / s_c^2 / sum(d_k^2 / s_k^2).
pub(super) fn of(photo: &Photo, surface: &WallSurface, stain: &StainMask) -> PixelRaster {
    let weights = weights(surface, stain);
    let sign = if surface.lighter { -1.0 } else { 1.0 };
    let (width, height) = (photo.logs[0].width, photo.logs[0].height);
    let mut values = vec![0.0f32; width * height];
    let scale = 1.0 / surface.factor as f64;
    values.par_chunks_exact_mut(width).enumerate().for_each(|(j, row)| {
        let y = (j as f64 + 0.5) * scale;
        for (i, value) in row.iter_mut().enumerate() {
            let x = (i as f64 + 0.5) * scale;
            let of_channel = |c: usize| surface.wall[c].sample(x, y) - photo.logs[c].values[j * width + i];
            *value = sign * (0..3).map(|c| weights[c] * of_channel(c)).sum::<f32>();
        }
    });
    PixelRaster { width, height, values }
}

/// Weight of each channel.
fn weights(surface: &WallSurface, stain: &StainMask) -> [f32; 3] {
    let sums = [0, 1, 2].map(|channel: usize| {
        let values = surface.residuals[channel].values.iter().zip(&stain.core);
        values.filter(|(_, core)| **core).map(|(value, _)| f64::from(*value)).sum::<f64>()
    });
    let total = sums.iter().sum::<f64>() / 3.0;
    // A channel that the stain hardly changes, or lightens, gets little weight.
    let darkens = sums.map(|sum| if total > 0.0 { (sum / total).max(0.05) } else { 1.0 });
    let variances = [0, 1, 2].map(|channel: usize| {
        let values = surface.residuals[channel].values.iter().zip(&stain.clean).filter(|(_, clean)| **clean);
        let (sum, count) = values.fold((0.0, 0.0), |(sum, count), (v, _)| (sum + f64::from(v * v), count + 1.0));
        // A floor for the errors of the fit keeps one channel from taking all the weight.
        sum / f64::max(count, 1.0) + 1e-5
    });
    let norm: f64 = darkens.iter().zip(&variances).map(|(d, variance)| d * d / variance).sum();
    [0, 1, 2].map(|c: usize| (darkens[c] / variances[c] / norm) as f32)
}
