//! The process that is fed: a panic, a crash, an endless loop or too much memory there is seen from outside.

use std::cell::RefCell;
use std::fmt;
use std::fs;
use std::io::{BufRead, BufReader};
use std::ops::Range;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::str::FromStr;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use snellius::scene::Limits;

use super::attacks::{self, Attack};
use super::mutate;
use super::targets::{Feeder, Outcome, SMALL};

/// Says what a worker is to do.
const VARIABLE: &str = "SNELLIUS_FUZZ";
/// How long an input may take, on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);
/// The most memory that a worker may ever have held, in KiB: 1 GB.
const MOST_MEMORY: u64 = 1_000_000_000 / 1024;
/// Starts each line that a worker says, among what panics say.
const SIGN: &str = "fuzz:";

/// What a worker is to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Task {
    /// Feed a target inputs of these numbers.
    Inputs(String, Range<u64>),
    /// Make every attack.
    Attacks,
}

impl fmt::Display for Task {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Inputs(target, range) => write!(f, "{target} {}..{}", range.start, range.end),
            Self::Attacks => f.write_str("attacks"),
        }
    }
}

impl FromStr for Task {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let inputs = || {
            let (target, range) = text.split_once(' ')?;
            let (start, end) = range.split_once("..")?;
            Some(Self::Inputs(target.to_owned(), start.parse().ok()?..end.parse().ok()?))
        };
        if text == "attacks" { Ok(Self::Attacks) } else { inputs().ok_or_else(|| format!("no task: {text}")) }
    }
}

/// What a worker found.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Findings {
    /// Inputs fed.
    pub(super) inputs: u64,
    /// How many of them gave a picture.
    pub(super) traced: u64,
    /// The longest time that one took, in milliseconds, and its number.
    pub(super) slowest: (u64, u64),
    /// The most memory that the process ever held, in KiB; 0 where the system does not tell.
    pub(super) memory: u64,
}

impl fmt::Display for Findings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { inputs, traced, slowest: (milliseconds, number), memory } = self;
        write!(f, "{inputs} {traced} {milliseconds} {number} {memory}")
    }
}

impl FromStr for Findings {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Option<Vec<u64>> = text.split(' ').map(|word| word.parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[inputs, traced, milliseconds, number, memory]) => {
                Ok(Self { inputs, traced, slowest: (milliseconds, number), memory })
            }
            _ => Err(format!("no findings: {text}")),
        }
    }
}

/// Do a task in a process of its own.
///
/// # Errors
/// What went wrong there, and how to see it again.
pub(super) fn employ(task: &Task) -> Result<Findings, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let mut child = Command::new(program)
        .args(["--exact", "fuzz::worker_process", "--ignored", "--nocapture"])
        .env(VARIABLE, task.to_string())
        .env("RUST_BACKTRACE", "0")
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| error.to_string())?;
    let heard = listen(&mut child);
    let ended = child.wait().map_err(|error| error.to_string())?;
    match heard {
        Ok(findings) if !ended.success() => Err(format!("the worker ended with {ended} after {findings}")),
        Ok(findings) if findings.memory > MOST_MEMORY => {
            Err(format!("{task}: the worker held {} MB", findings.memory * 1024 / 1_000_000))
        }
        Ok(findings) => Ok(findings),
        Err(Silence { last: Some(number), said }) => Err(report(task, number, &said)),
        Err(Silence { last: None, said }) => Err(format!("{task}: {said}")),
    }
}

/// Why there are no findings: the number of the last input, and what was said since.
struct Silence {
    last: Option<u64>,
    said: String,
}

/// Hear a worker to its end; kill it where an input takes too long.
fn listen(child: &mut Child) -> Result<Findings, Silence> {
    let lines = lines(child);
    let mut silence = Silence { last: None, said: String::new() };
    loop {
        match lines.recv_timeout(PATIENCE) {
            Ok(line) => match line.strip_prefix(SIGN).map(str::trim) {
                None => silence.said += &format!("{line}\n"),
                Some(number) if !number.contains(' ') => silence.last = number.parse().ok(),
                Some(findings) => return findings.parse().map_err(|said| Silence { said, ..silence }),
            },
            Err(RecvTimeoutError::Disconnected) => return Err(silence),
            Err(RecvTimeoutError::Timeout) => {
                // It may have ended by itself in between.
                drop(child.kill());
                silence.said += &format!("it takes more than {} s\n", PATIENCE.as_secs());
                return Err(silence);
            }
        }
    }
}

/// What a child says, line by line, without waiting for it.
fn lines(child: &mut Child) -> Receiver<String> {
    let (sender, receiver) = channel();
    if let Some(stream) = child.stderr.take() {
        std::thread::spawn(move || {
            BufReader::new(stream).lines().map_while(Result::ok).try_for_each(|line| sender.send(line))
        });
    }
    receiver
}

/// What to tell about an input that a worker did not survive.
fn report(task: &Task, number: u64, said: &str) -> String {
    match task {
        Task::Attacks => format!("{}: {said}", attacks::all()[number as usize].name),
        Task::Inputs(target, _) => {
            let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
            let path = folder.join(format!("{target}-{number}"));
            let kept = fs::write(&path, mutate::input(&corpus(target), number));
            let kept = kept.map_or_else(|error| error.to_string(), |()| path.display().to_string());
            let replay = Task::Inputs(target.clone(), number..number + 1);
            format!("{target} {number}: {said}the input: {kept}\nreplay: {VARIABLE}=\"{replay}\" {REPLAY}")
        }
    }
}

const REPLAY: &str = "cargo test --release --test main -- --ignored --exact fuzz::worker_process --nocapture";

/// In the worker: do the task of the environment, if there is one.
pub(super) fn work() {
    let Ok(task) = std::env::var(VARIABLE) else { return };
    let findings = match task.parse().expect("a task") {
        Task::Inputs(target, range) => feed_all(&target, range),
        Task::Attacks => attack_all(),
    };
    eprintln!("{SIGN} {findings}");
}

fn feed_all(name: &str, numbers: Range<u64>) -> Findings {
    let corpus = corpus(name);
    let feeder = Feeder::new(name, SMALL);
    feed(numbers, |number| feeder.feed(&mutate::input(&corpus, number)))
}

fn attack_all() -> Findings {
    let attacks = attacks::all();
    let untold = RefCell::new(Vec::new());
    let findings = feed(0..attacks.len() as u64, |number| {
        let Attack { name, target, input, says } = &attacks[number as usize];
        let outcome = Feeder::new(target, Limits::default()).feed(input);
        if !matches!(&outcome, Outcome::Refused(message) if message.contains(says)) {
            untold.borrow_mut().push(format!("{name}: not {says:?}, but {outcome:.500?}"));
        }
        outcome
    });
    assert!(untold.borrow().is_empty(), "{}", untold.borrow().join("\n"));
    findings
}

/// Say each number, and time what is done with it.
fn feed(numbers: Range<u64>, one: impl Fn(u64) -> Outcome) -> Findings {
    let mut findings = Findings::default();
    for number in numbers {
        eprintln!("{SIGN} {number}");
        let start = Instant::now();
        let outcome = one(number);
        findings.slowest = findings.slowest.max((start.elapsed().as_millis() as u64, number));
        findings.inputs += 1;
        findings.traced += u64::from(outcome == Outcome::Traced);
    }
    Findings { memory: greatest_memory(), ..findings }
}

/// The seeds of a target, in order of their names.
fn corpus(name: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus").join(name);
    let entries = fs::read_dir(folder).expect("a corpus");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort_unstable();
    paths.iter().map(|path| fs::read(path).expect("a seed")).collect()
}

/// The most memory that this process ever held, in KiB (Linux: `VmHWM` of proc(5)).
fn greatest_memory() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse().ok()).unwrap_or(0)
}
