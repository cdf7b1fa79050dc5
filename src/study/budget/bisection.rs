//! Searching for the coarsest settings that will do.

use super::super::StudyError;

/// The first of the trials `from..=to` that is kept, if each is finer than the one before and what keeps one keeps all
/// finer ones: by bisection.
///
/// # Errors
/// The trials' own.
pub(super) fn first<T>(
    [from, to]: [i32; 2],
    mut try_out: impl FnMut(i32) -> Result<T, StudyError>,
    keeps: impl Fn(&T) -> bool,
) -> Result<Option<T>, StudyError> {
    let (mut low, mut high, mut found) = (from, to + 1, None);
    while low < high {
        // Rounded down, below zero too.
        let middle = low + (high - low) / 2;
        let tried = try_out(middle)?;
        if keeps(&tried) {
            found = Some(tried);
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    Ok(found)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn the_first_that_is_kept_is_found_at_any_place_and_none_where_none_is() {
        for least in -3..=9 {
            let found = first([-3, 8], Ok, |&at| at >= least).unwrap();
            assert_eq!(found, (least <= 8).then_some(least));
        }
    }
}
