//! The precision probe: what an adapter makes of single operations and of sums of products. It explains the figures of the
//! cases. Twin of `shaders/probe_arithmetic.wgsl`.

use super::{DeviceError, GpuDevice, Random};
use crate::layout::Float;

/// What an adapter's f32 is, in one kind of float.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Arithmetic {
    /// Its errors against f64.
    pub operations: Vec<Operation>,
    /// What it computes otherwise than written.
    pub rewrites: Vec<Rewrite>,
    /// Whether a subnormal result is kept; else it becomes 0.
    pub keeps_subnormals: bool,
    /// Whether 0·(−1) is −0.
    pub keeps_sign_of_zero: bool,
}

/// An operation's error.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Operation {
    /// As WGSL writes it.
    pub name: &'static str,
    /// Greatest error against f64, in units in the last place of the f32 result: 0.5 is correctly rounded.
    pub ulps: f64,
    /// What the WGSL specification allows, in the same units; none where it inherits other errors.
    pub allowed: Option<f64>,
}

/// How often an expression's bits are not those of its operations, each rounded.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Rewrite {
    /// As WGSL writes it.
    pub expression: &'static str,
    /// Share of the inputs, in [0, 1].
    pub share: f64,
}

/// Inputs.
const COUNT: usize = 1 << 15;
/// Words of a record: as many as are written.
const STRIDE: usize = 13;
/// Half of it is subnormal: 2^-126.
const TINY: f32 = f32::MIN_POSITIVE;

/// Numbers that go in: a, b, c, d.
type Numbers = [f32; 4];
/// An operation by name, its value in f64 from exact inputs, and its allowed error (the WGSL specification, "Floating
/// point accuracy"; exp: 3 + 2·|x|, with |x| ≤ 8 here).
type Exact = (&'static str, fn(Numbers) -> f64, Option<f64>);
/// An expression as written, and its value with every operation rounded.
type Written = (&'static str, fn(Numbers) -> f32);

/// In the order of the shader.
const OPERATIONS: [Exact; 6] = [
    ("a / b", |[a, b, ..]| f64::from(a) / f64::from(b), Some(2.5)),
    ("sqrt(a)", |[a, ..]| f64::from(a.abs()).sqrt(), None),
    ("inverseSqrt(a)", |[a, ..]| 1.0 / f64::from(a.abs()).sqrt(), Some(2.0)),
    ("exp(a)", |[_, _, c, _]| f64::from(c).exp(), Some(19.0)),
    ("pow(a, b)", |[a, _, c, _]| f64::from(a.abs()).powf(f64::from(c)), None),
    ("fma(a, b, c)", |[a, b, _, d]| f64::from(a).mul_add(f64::from(b), f64::from(d)), None),
];

/// Behind them.
const EXPRESSIONS: [Written; 5] = [
    ("a * b - c * b", |[a, b, _, d]| a * b - d * b),
    ("a * b + a * c", |[a, b, _, d]| a * b + a * d),
    ("(a + b) - a", |[a, b, ..]| (a + b) - a),
    ("sqrt(a) * sqrt(a)", |[a, ..]| a.abs().sqrt() * a.abs().sqrt()),
    ("a / 3", |[a, ..]| a / 3.0),
];

impl GpuDevice {
    /// Measure the adapter's arithmetic in one kind of float, strict where it can be.
    ///
    /// # Errors
    /// As the device's.
    pub fn arithmetic(&mut self, float: Float) -> Result<Arithmetic, DeviceError> {
        let inputs = inputs();
        let mut records: Vec<u32> = inputs.iter().flat_map(record).collect();
        self.probe(("probe_arithmetic", "probe_arithmetic"), float, STRIDE, &mut records)?;
        let results: Vec<[f32; STRIDE]> = records
            .chunks_exact(STRIDE)
            .map(|record| std::array::from_fn(|index| f32::from_bits(record[index])))
            .collect();
        Ok(Arithmetic::new(&inputs, &results))
    }
}

/// Numbers between 2^-13 and 2^13 of either sign, every magnitude alike; the third, an exponent, between -8 and 8.
fn inputs() -> Vec<Numbers> {
    let mut random = Random::new("arithmetic");
    let mut number = || random.log_uniform(-4.0, 4.0) as f32;
    let numbers: Vec<[f32; 3]> = (0..COUNT).map(|_| [number(), number(), number()]).collect();
    numbers.into_iter().map(|[a, b, d]| [a, b, random.between(-8.0, 8.0) as f32, d]).collect()
}

fn record(numbers: &Numbers) -> [u32; STRIDE] {
    let mut words = [0; STRIDE];
    for (word, number) in words.iter_mut().zip(numbers.iter().chain(&[TINY, 0.0])) {
        *word = number.to_bits();
    }
    words
}

impl Arithmetic {
    fn new(inputs: &[Numbers], results: &[[f32; STRIDE]]) -> Self {
        let pairs = || inputs.iter().zip(results);
        let operations = OPERATIONS.iter().enumerate().map(|(index, &(name, exact, allowed))| {
            let errors = pairs().map(|(numbers, result)| error_in_ulps(result[index], exact(*numbers)));
            Operation { name, ulps: errors.fold(0.0, f64::max), allowed }
        });
        let rewrites = EXPRESSIONS.iter().enumerate().map(|(index, &(expression, written))| {
            let index = OPERATIONS.len() + index;
            let differing =
                pairs().filter(|(numbers, result)| result[index].to_bits() != written(**numbers).to_bits());
            Rewrite { expression, share: differing.count() as f64 / inputs.len() as f64 }
        });
        let [.., half_tiny, minus_zero] = results.first().copied().unwrap_or([0.0; STRIDE]);
        Self {
            operations: operations.collect(),
            rewrites: rewrites.collect(),
            keeps_subnormals: half_tiny == TINY * 0.5,
            keeps_sign_of_zero: minus_zero == 0.0 && minus_zero.is_sign_negative(),
        }
    }
}

/// In units in the last place of the exact value; 0 where that is beyond f32 or subnormal.
fn error_in_ulps(found: f32, exact: f64) -> f64 {
    let magnitude = exact.abs();
    if !(f64::from(f32::MIN_POSITIVE)..f64::from(f32::MAX)).contains(&magnitude) {
        return 0.0;
    }
    (f64::from(found) - exact).abs() / 2f64.powf(magnitude.log2().floor() - 23.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the CPU itself writes, with an fma of two roundings.
    fn results(inputs: &[Numbers]) -> Vec<[f32; STRIDE]> {
        let result = |&numbers: &Numbers| {
            let [a, b, _, d] = numbers;
            let mut words = [0.0; STRIDE];
            for (word, (_, exact, _)) in words.iter_mut().zip(OPERATIONS) {
                *word = exact(numbers) as f32;
            }
            words[5] = a * b + d;
            for (word, (_, written)) in words[6..].iter_mut().zip(EXPRESSIONS) {
                *word = written(numbers);
            }
            words[6] = a.mul_add(b, -(d * b));
            [words[11], words[12]] = [TINY * 0.5, -0.0];
            words
        };
        inputs.iter().map(result).collect()
    }

    #[test]
    fn what_is_rounded_or_rewritten_shows() {
        let inputs = inputs();
        let found = Arithmetic::new(&inputs, &results(&inputs));
        assert!(found.operations[..5].iter().all(|one| one.ulps <= 0.5), "{found:?}");
        assert!(found.operations[5].ulps > 0.5, "two roundings are one too many for fma");
        assert!(found.rewrites[0].share > 0.1, "a fused product shows");
        assert!(found.rewrites[1..].iter().all(|one| one.share == 0.0));
        assert!(found.keeps_subnormals && found.keeps_sign_of_zero);
    }
}
