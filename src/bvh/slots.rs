//! Which number each child of a wide node gets.

use super::collapse::{Part, WIDTH};

/// For each number the child that has it. Bit i of a child's number says that it lies on the upper side along axis i, as
/// well as all of them together can (Ylitie, Karras, Laine 2017, section 3.3, by greedy choice).
pub(super) fn by_octant(parts: &[Part]) -> [Option<usize>; WIDTH] {
    let centre = |part: &Part| -> [f64; 3] {
        std::array::from_fn(|axis| f64::midpoint(f64::from(part.lo[axis]), f64::from(part.hi[axis])))
    };
    let count = parts.len() as f64;
    let mean: [f64; 3] =
        std::array::from_fn(|axis| parts.iter().map(|part| centre(part)[axis]).sum::<f64>() / count);
    let gain = |part: &Part, slot: usize| -> f64 {
        let from_mean = |axis: usize| centre(part)[axis] - mean[axis];
        (0..3).map(|axis| if slot >> axis & 1 == 1 { from_mean(axis) } else { -from_mean(axis) }).sum()
    };
    let gains: Vec<[f64; WIDTH]> =
        parts.iter().map(|part| std::array::from_fn(|slot| gain(part, slot))).collect();
    let mut slots = [None; WIDTH];
    let mut left: Vec<usize> = (0..parts.len()).collect();
    while !left.is_empty() {
        let free = |&slot: &usize| slots[slot].is_none();
        let pairs = left
            .iter()
            .enumerate()
            .flat_map(|(place, &index)| (0..WIDTH).filter(free).map(move |slot| (place, index, slot)));
        let best = pairs
            .map(|pair| (gains[pair.1][pair.2], pair))
            .reduce(|best, next| if next.0 > best.0 { next } else { best });
        let Some((_, (place, index, slot))) = best else { break };
        slots[slot] = Some(index);
        left.swap_remove(place);
    }
    slots
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corners_of_a_cube_get_their_octants() {
        // Listed upside down.
        let corner = |number: usize| {
            let lo = std::array::from_fn(|axis| (number >> axis & 1) as f32 * 10.0);
            Part { lo, hi: lo.map(|x| x + 1.0), inner: None, first: 0, count: 1 }
        };
        let parts: Vec<_> = (0..WIDTH).rev().map(corner).collect();
        assert_eq!(by_octant(&parts), std::array::from_fn(|slot| Some(WIDTH - 1 - slot)));
    }

    #[test]
    fn every_child_gets_one_number() {
        let same = Part { lo: [0.0; 3], hi: [1.0; 3], inner: None, first: 0, count: 1 };
        for count in 1..=WIDTH {
            let mut found: Vec<_> = by_octant(&vec![same; count]).into_iter().flatten().collect();
            found.sort_unstable();
            assert_eq!(found, (0..count).collect::<Vec<_>>());
        }
    }
}
