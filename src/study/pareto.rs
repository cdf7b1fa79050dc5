//! Which rows are worth their time.

/// The Pareto front of (time, error) points: the indices of those that no other point beats in both, by time.
///
/// Of equal points the first is taken. A point that is not finite is on no front.
pub(super) fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> =
        (0..points.len()).filter(|&i| points[i].0.is_finite() && points[i].1.is_finite()).collect();
    order.sort_by(|&a, &b| {
        let ((time_a, error_a), (time_b, error_b)) = (points[a], points[b]);
        time_a.total_cmp(&time_b).then(error_a.total_cmp(&error_b))
    });
    let mut least = f64::INFINITY;
    order.retain(|&i| {
        let better = points[i].1 < least;
        least = least.min(points[i].1);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beaten_points_are_not_on_the_front() {
        let points = [(3.0, 0.1), (1.0, 0.5), (2.0, 0.6), (2.0, 0.2), (4.0, 0.1)];
        assert_eq!(front(&points), [1, 3, 0]);
    }

    #[test]
    fn what_is_not_finite_is_on_no_front() {
        assert_eq!(front(&[(1.0, f64::NAN), (2.0, 0.5)]), [1]);
    }
}
