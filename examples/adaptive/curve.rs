//! Error against cost, between measured points.

/// A measured picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub(super) error: f64,
    pub(super) rays: f64,
}

/// Rays for this error on the curve of ever smaller errors: a power law between neighbouring points, none beyond them.
pub(super) fn rays_for(curve: &[Point], error: f64) -> Option<f64> {
    let between = |pair: &&[Point]| pair[0].error >= error && error >= pair[1].error;
    let pair = curve.windows(2).find(between)?;
    let [a, b] = [pair[0], pair[1]];
    let span = (b.error / a.error).ln();
    let part = if span == 0.0 { 0.0 } else { (error / a.error).ln() / span };
    Some(a.rays * (b.rays / a.rays).powf(part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_met_between_its_points_and_not_left() {
        // error = rays^(-1/2)
        let curve = [4.0, 16.0, 64.0].map(|rays: f64| Point { error: rays.powf(-0.5), rays });
        for rays in [4.0, 9.0, 25.0, 63.0_f64] {
            let found = rays_for(&curve, rays.powf(-0.5));
            assert!(found.is_some_and(|found| (found - rays).abs() < 1e-9), "{found:?}");
        }
        assert_eq!(rays_for(&curve, 0.6), None);
        assert_eq!(rays_for(&curve, 0.1), None);
    }
}
