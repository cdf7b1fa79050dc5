//! All other runs: rows take turns, for their times.

use super::StudyError;
use super::plan::Row;
use super::run::Course;

/// Runs of a row after its warm-up: 15 give an interval between the 4th and the 12th.
const RUNS: usize = 15;

impl Course<'_> {
    /// Let the rows take turns, so that what slows the machine down for a while slows all of them; until each
    /// has run often enough, or the time is over. Each round begins one row further on.
    pub(super) fn times(&mut self, rows: &[Row]) -> Result<(), StudyError> {
        let rows: Vec<&Row> = rows.iter().filter(|row| self.report.row(&row.id()).is_some()).collect();
        // A row may have three times its share.
        let share = self.left().as_secs_f64() * 3.0 / rows.len().max(1) as f64;
        for round in 0..RUNS {
            let mut ran = false;
            for turn in 0..rows.len() {
                let row = rows[(turn + round) % rows.len()];
                ran |= self.another_run(row, round, share)?;
            }
            self.save()?;
            if !ran {
                break;
            }
        }
        Ok(())
    }

    /// One more run of a row, if it is its turn and there is time.
    fn another_run(&mut self, row: &Row, round: usize, share: f64) -> Result<bool, StudyError> {
        let id = row.id();
        let Some(record) = self.report.row(&id) else { return Ok(false) };
        let (runs, expected) = (record.times_ms.len(), record.time() / 1e3);
        let taken = record.times_ms.iter().sum::<f64>() / 1e3;
        if runs > round || taken + expected > share || expected > self.left().as_secs_f64() {
            return Ok(false);
        }
        self.say(&format!("timing, round {} of {RUNS}: {id}", round + 1));
        let Some(shot) = self.lab.shoot(&row.setup, self.budget)? else { return Ok(false) };
        if let Some(record) = self.report.rows.iter_mut().find(|record| record.id == id) {
            record.times_ms.push(shot.time.as_secs_f64() * 1e3);
        }
        Ok(true)
    }
}
