//! A straight line through logarithms.

/// The exponent of the power that is nearest to points (x, y), both above 0: least squares of the logarithms. 0 where all
/// x are the same.
pub(super) fn exponent(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let logs: Vec<(f64, f64)> = points.map(|(x, y)| (x.ln(), y.ln())).collect();
    let [mean_x, mean_y] = mean(&logs);
    let along: f64 = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let squares: f64 = logs.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    if squares > 0.0 { along / squares } else { 0.0 }
}

/// What the power of this exponent that is nearest to the points has at `x`.
pub(super) fn value_at(x: f64, exponent: f64, points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let logs: Vec<(f64, f64)> = points.map(|(x, y)| (x.ln(), y.ln())).collect();
    let [mean_x, mean_y] = mean(&logs);
    (mean_y + exponent * (x.ln() - mean_x)).exp()
}

fn mean(points: &[(f64, f64)]) -> [f64; 2] {
    let count = points.len().max(1) as f64;
    let [x, y] = points.iter().fold([0.0, 0.0], |[a, b], (x, y)| [a + x, b + y]);
    [x / count, y / count]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponent_of_a_power_is_found() {
        let cube = || [1.0, 2.0, 5.0, 40.0].into_iter().map(|x: f64| (x, 7.0 * x.powi(3)));
        assert!((exponent(cube()) - 3.0).abs() < 1e-12);
        assert!((value_at(10.0, 3.0, cube()) - 7000.0).abs() < 1e-6);
    }

    #[test]
    fn noise_on_both_sides_leaves_it_alone() {
        let points = [(1.0, 1.0), (10.0, 10.0 * 1.1), (100.0, 100.0 / 1.1), (1000.0, 1000.0)];
        assert!((exponent(points.into_iter()) - 1.0).abs() < 0.02);
    }

    #[test]
    fn points_above_each_other_have_none() {
        assert_eq!(exponent([(3.0, 1.0), (3.0, 2.0)].into_iter()), 0.0);
    }
}
