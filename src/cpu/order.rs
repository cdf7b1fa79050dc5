//! The order of pixels or tiles in which neighbours come soon after each other.

/// Column and row of every cell of a table, along a Morton curve: what is read for one cell is still near for the next.
#[must_use]
pub fn morton_order(columns: u32, rows: u32) -> Vec<[u32; 2]> {
    let mut cells: Vec<_> = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row])).collect();
    cells.sort_by_cached_key(|&[column, row]| spread(column) | spread(row) << 1);
    cells
}

/// The bits of a number on every other place.
fn spread(x: u32) -> u64 {
    (0..32).fold(0, |spread, bit| spread | u64::from(x >> bit & 1) << (2 * bit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_comes_once_block_by_block() {
        let cells = morton_order(3, 5);
        assert_eq!(cells[..6], [[0, 0], [1, 0], [0, 1], [1, 1], [2, 0], [2, 1]]);
        let mut sorted = cells.clone();
        sorted.sort_unstable();
        sorted.dedup();
        assert_eq!((cells.len(), sorted.len()), (15, 15));
    }
}
