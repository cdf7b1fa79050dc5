//! An OBJ file as tobj is to read it: proven statements only, each on a line of its own, in their plainest form.

use std::io::{self, BufRead, Read};

use super::scan::Scan;
use crate::scene::SceneError;
use crate::scene::source::Source;
use crate::scene::statement::Statements;

/// Reads the proven statements of a source, scanning as far as it is read. Fails at the first fault.
#[derive(Debug)]
pub(super) struct Proven<'a> {
    statements: Statements<'a>,
    scan: Scan,
    fault: Option<SceneError>,
    /// The current line, and how much of it is read.
    line: String,
    read: usize,
}

impl<'a> Proven<'a> {
    pub(super) fn new(source: &'a Source) -> Self {
        Self {
            statements: Statements::new(source),
            scan: Scan::default(),
            fault: None,
            line: String::new(),
            read: 0,
        }
    }

    /// What the scan knows of the file.
    ///
    /// # Errors
    /// The fault at which reading failed.
    pub(super) fn into_scan(self) -> Result<Scan, SceneError> {
        self.fault.map_or(Ok(self.scan), Err)
    }
}

impl BufRead for Proven<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.read == self.line.len() {
            self.line.clear();
            self.read = 0;
        }
        while self.line.is_empty()
            && let Some(statement) = self.statements.next()
        {
            if let Err(fault) = self.scan.prove(&statement, &mut self.line) {
                self.fault = Some(fault);
                return Err(io::ErrorKind::InvalidData.into());
            }
        }
        Ok(&self.line.as_bytes()[self.read..])
    }

    fn consume(&mut self, amount: usize) {
        self.read += amount;
    }
}

impl Read for Proven<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let amount = self.fill_buf()?.read(buffer)?;
        self.consume(amount);
        Ok(amount)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::path::Path;

    use super::*;

    fn read(text: &str) -> (io::Result<String>, Result<Scan, SceneError>) {
        let source = Source::new(Path::new("a.obj"), text.into());
        let mut proven = Proven::new(&source);
        (io::read_to_string(&mut proven), proven.into_scan())
    }

    #[test]
    fn statements_take_their_plainest_form() {
        let text = "# mesh\no cube\nv 0 0 0 1 # weight\n v 1.5 0 0 \\\r\n 0.5 0.5 0.5 9\nv\t0 1e0 0\nvt 0.5\n\
                    vt 1 0 0.5\nvn 0 0 2\nusemtl red\ng a\nf 1/1 2/2 3/2 # face\nfo -3 -2 \\\n -1";
        assert_eq!(
            read(text).0.unwrap(),
            "v 0 0 0\nv 1.5 0 0\nv 0 1e0 0\nvt 0.5 0\nvt 1 0\nvn 0 0 2\nf 1/1 2/2 3/2\nf -3 -2 -1\n"
        );
    }

    #[test]
    fn reading_stops_at_a_fault_and_keeps_it() {
        let (text, scan) = read("v 0 0 0\nv 0 0\nv 0 0 0\n");
        assert_eq!(text.unwrap_err().kind(), io::ErrorKind::InvalidData);
        assert_eq!(scan.unwrap_err().diagnostics()[0].message, "`v` needs 3 numbers, found 2");
    }

    #[test]
    fn faces_alike_are_counted_together() {
        let text = "v 0 0 0\nvt 0 0\nf 1 1 1\nf 1 1 1 1\nusemtl a\ns 1\nf 1 1 1\nf 1/1 1/1 1/1\n";
        let runs = read(text).1.unwrap().runs;
        let counts: Vec<_> = runs.iter().map(|run| (run.slot, run.style.has_uvs, run.faces)).collect();
        assert_eq!(counts, [(0, false, 2), (1, false, 1), (1, true, 1)]);
    }
}
