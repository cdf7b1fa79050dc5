//! Inputs that are almost right: seeds of the corpus, changed where it hurts.

use std::ops::Range;

use snellius::selftest::Random;

/// The longest input, in bytes.
const MOST_BYTES: usize = 1 << 16;
/// The most changes of one input.
const MOST_CHANGES: usize = 12;

/// Numbers at the ends of what a reader, f32, f64 or an integer can hold.
const EXTREMES: [&str; 40] = [
    "0",
    "-0",
    "0.0",
    "-1",
    "1",
    "2",
    "3",
    "7",
    "9",
    "63",
    "64",
    "65",
    "99",
    "255",
    "256",
    "16384",
    "16385",
    "65536",
    "1000000",
    "1000000000",
    "2147483648",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "99999999999999999999",
    "1e-400",
    "1e-46",
    "1e-38",
    "1e-19",
    "1e18",
    "1e19",
    "1e38",
    "3.5e38",
    "1e300",
    "1e400",
    "nan",
    "-inf",
    "0.99999999999999999",
    "1.0000000000000002",
];

/// Sizes and offsets of binary files at the ends of what they can hold.
const WORDS: [u32; 10] = [0, 1, 0x7f, 0xff, 0x7fff, 0xffff, 0xea60, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff];

/// Input number `number` of a corpus of at least one seed: the same for ever, while the corpus stays.
pub(super) fn input(corpus: &[Vec<u8>], number: u64) -> Vec<u8> {
    let mut random = Random::new(&number.to_string());
    let mut bytes = one_of(&mut random, corpus).clone();
    let is_text = std::str::from_utf8(&bytes).is_ok_and(|text| !text.starts_with("#?RADIANCE"));
    // One change is as likely as two to four, and as five to twelve: some faults take several, most are hidden by them.
    let most = *one_of(&mut random, &[1, 4, MOST_CHANGES]);
    let changes = 1 + below(&mut random, most);
    for _ in 0..changes {
        match below(&mut random, 4) {
            0 => change_bytes(&mut bytes, &mut random),
            _ if is_text => change_text(&mut bytes, corpus, &mut random),
            _ => change_word(&mut bytes, &mut random),
        }
        bytes.truncate(MOST_BYTES);
    }
    // Most readers stop at a wrong checksum.
    if below(&mut random, 8) != 0 {
        png::mend(&mut bytes);
    }
    bytes
}

/// Below `end`; 0 where that is 0.
fn below(random: &mut Random, end: usize) -> usize {
    random.below(end.max(1) as u32) as usize
}

fn one_of<'a, T>(random: &mut Random, items: &'a [T]) -> &'a T {
    &items[below(random, items.len())]
}

/// A part of `0..len`, short ones more often.
fn part(random: &mut Random, len: usize) -> Range<usize> {
    let start = below(random, len);
    let longest = 1 << below(random, 12);
    start..start + below(random, (len - start).min(longest) + 1)
}

/// Flip, set, cut out, double, move or cut off bytes.
fn change_bytes(bytes: &mut Vec<u8>, random: &mut Random) {
    let part = part(random, bytes.len());
    match below(random, 8) {
        0..=2 => {
            let at = below(random, bytes.len());
            let bit = 1 << below(random, 8);
            bytes.get_mut(at).into_iter().for_each(|byte| *byte ^= bit);
        }
        3 => {
            let byte = random.word() as u8;
            bytes.insert(part.start, byte);
        }
        4 => drop(bytes.drain(part)),
        5 => {
            let copy = bytes[part].to_vec();
            let at = below(random, bytes.len() + 1);
            bytes.splice(at..at, copy);
        }
        6 => bytes[part].reverse(),
        _ => bytes.truncate(part.start),
    }
}

/// Set 1, 2 or 4 bytes of either order.
fn change_word(bytes: &mut [u8], random: &mut Random) {
    let word = *one_of(random, &WORDS);
    let (big, little) = (word.to_be_bytes(), word.to_le_bytes());
    let choices: [&[u8]; 5] = [&big[3..], &big[2..], &little[..2], &big, &little];
    let chosen = *one_of(random, &choices);
    let at = below(random, (bytes.len() + 1).saturating_sub(chosen.len()));
    if let Some(place) = bytes.get_mut(at..at + chosen.len()) {
        place.copy_from_slice(chosen);
    }
}

/// Change words, numbers and lines.
fn change_text(bytes: &mut Vec<u8>, corpus: &[Vec<u8>], random: &mut Random) {
    let (tokens, lines) = (tokens(bytes), lines(bytes));
    if tokens.is_empty() || lines.is_empty() {
        return bytes.extend_from_slice(one_of(random, corpus).as_slice());
    }
    let token = one_of(random, &tokens).clone();
    let line = one_of(random, &lines).clone();
    match below(random, 8) {
        0..=2 => {
            let numbers: Vec<_> = tokens.iter().filter(|token| is_number(&bytes[(*token).clone()])).collect();
            if numbers.is_empty() {
                return;
            }
            let place = (*one_of(random, &numbers)).clone();
            let number = match below(random, 3) {
                0 => format!("{}", below(random, 12)),
                1 => format!("{}.{}", below(random, 4), below(random, 1000)),
                _ => (*one_of(random, &EXTREMES)).to_owned(),
            };
            bytes.splice(place, number.into_bytes());
        }
        3 => {
            let other = one_of(random, corpus);
            let words = self::tokens(other);
            let word = other[one_of(random, &words).clone()].to_vec();
            bytes.splice(token, word);
        }
        4 => {
            let other = one_of(random, &tokens).clone();
            let (first, second) = if token.start < other.start { (token, other) } else { (other, token) };
            if first != second {
                let (a, b) = (bytes[first.clone()].to_vec(), bytes[second.clone()].to_vec());
                bytes.splice(second, a);
                bytes.splice(first, b);
            }
        }
        5 => drop(bytes.drain(line)),
        6 => {
            let copies = 1 << below(random, 7);
            let line = bytes[line].repeat(copies);
            let at = one_of(random, &lines).start;
            bytes.splice(at..at, line);
        }
        _ => {
            let other = one_of(random, corpus);
            let line = other[one_of(random, &self::lines(other)).clone()].to_vec();
            let at = one_of(random, &lines).start;
            bytes.splice(at..at, line);
        }
    }
}

/// Words, numbers, and every other character but blanks.
fn tokens(bytes: &[u8]) -> Vec<Range<usize>> {
    let joins = |byte: &u8| byte.is_ascii_alphanumeric() || b"._-+".contains(byte);
    let mut tokens = Vec::new();
    let mut start = 0;
    for group in bytes.chunk_by(|a, b| joins(a) && joins(b)) {
        if !group[0].is_ascii_whitespace() {
            tokens.push(start..start + group.len());
        }
        start += group.len();
    }
    tokens
}

fn is_number(token: &[u8]) -> bool {
    token.iter().any(u8::is_ascii_digit) && token[0] != b'#' && !token[0].is_ascii_alphabetic()
}

/// Lines with their ends.
fn lines(bytes: &[u8]) -> Vec<Range<usize>> {
    let mut start = 0;
    let line = |line: &[u8]| {
        start += line.len();
        start - line.len()..start
    };
    bytes.split_inclusive(|&byte| byte == b'\n').map(line).collect()
}

/// The checksums of PNG chunks (PNG specification, section 5).
pub(super) mod png {
    const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

    /// Make every checksum right, as far as the chunks can be told apart.
    pub(in crate::fuzz) fn mend(bytes: &mut [u8]) {
        if !bytes.starts_with(SIGNATURE) {
            return;
        }
        let mut rest = &mut bytes[SIGNATURE.len()..];
        // Each: length, four letters, data, checksum of letters and data.
        while let Some((length, chunk)) = rest.split_first_chunk_mut() {
            let covered = (u32::from_be_bytes(*length) as usize).saturating_add(4);
            let Some((covered, behind)) = chunk.split_at_mut_checked(covered) else { return };
            let Some((sum, next)) = behind.split_first_chunk_mut() else { return };
            *sum = checksum(covered).to_be_bytes();
            rest = next;
        }
    }

    /// CRC-32 of ISO 3309.
    pub(super) fn checksum(bytes: &[u8]) -> u32 {
        let step = |sum: u32, _| if sum & 1 == 0 { sum >> 1 } else { (sum >> 1) ^ 0xedb8_8320 };
        !bytes.iter().fold(u32::MAX, |sum, &byte| (0..8).fold(sum ^ u32::from(byte), step))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_are_the_same_every_time_and_differ_from_each_other() {
        let corpus = vec![b"v 0 0.5 1e3\nf 1 2 3\n".to_vec()];
        assert_eq!(input(&corpus, 7), input(&corpus, 7));
        let mut inputs: Vec<_> = (0..1000).map(|number| input(&corpus, number)).collect();
        inputs.sort_unstable();
        inputs.dedup();
        assert!(inputs.len() > 700, "{}", inputs.len());
    }

    #[test]
    fn tokens_are_words_numbers_and_signs() {
        let text = b"eye = [-1.5e3, 2]\n#a";
        let found: Vec<_> = tokens(text).into_iter().map(|token| &text[token]).collect();
        let expected: [&[u8]; 9] = [b"eye", b"=", b"[", b"-1.5e3", b",", b"2", b"]", b"#", b"a"];
        assert_eq!(found, expected);
    }

    #[test]
    fn the_checksum_is_that_of_the_standard() {
        assert_eq!(png::checksum(b"123456789"), 0xcbf4_3926);
    }

    #[test]
    fn checksums_are_mended() {
        let whole = include_bytes!("corpus/picture/rgb8.png");
        let mut broken = whole.to_vec();
        // The last four bytes are the checksum of the last chunk.
        let last = broken.len() - 1;
        broken[last] ^= 1;
        png::mend(&mut broken);
        assert_eq!(broken, whole);
    }
}
