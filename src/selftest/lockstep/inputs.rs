//! Inputs of the probes: log-uniform, so that every magnitude is met, and the same in every run.

/// What one input is like.
pub(super) enum Input {
    /// A number of either sign, 2^-16 to 2^16 in magnitude.
    Number,
    /// A number in [0, 1]: evenly, and near both ends.
    Fraction,
    /// A number from 2^-8 to 2^8.
    Positive,
    /// Three coordinates in [-2, 2].
    Point,
    /// A direction of unit length, now and then along an axis or in a plane of two.
    Direction,
    /// A whole number below this.
    Word(u32),
    /// Any 32 bits.
    Bits,
}

impl Input {
    /// Words of a record that it takes.
    pub(super) fn words(&self) -> usize {
        match self {
            Self::Point | Self::Direction => 3,
            _ => 1,
        }
    }
}

/// PCG (O'Neill 2014), 32 bits.
pub(super) struct Generator(u32);

impl Generator {
    /// The inputs of the probe of that name.
    pub(super) fn new(name: &str) -> Self {
        Self(name.bytes().fold(1, |seed, byte| seed.wrapping_mul(31).wrapping_add(u32::from(byte))))
    }

    /// One record, filled up to `stride` words.
    pub(super) fn record(&mut self, inputs: &[Input], stride: usize) -> Vec<u32> {
        let mut words: Vec<u32> = inputs.iter().flat_map(|input| self.words(input)).collect();
        words.resize(stride, 0);
        words
    }

    fn words(&mut self, input: &Input) -> Vec<u32> {
        match input {
            Input::Number => vec![self.number().to_bits()],
            Input::Fraction => vec![self.fraction().to_bits()],
            Input::Positive => vec![(16.0 * self.uniform() - 8.0).exp2().to_bits()],
            Input::Point => (0..3).map(|_| (4.0 * self.uniform() - 2.0).to_bits()).collect(),
            Input::Direction => self.direction().map(f32::to_bits).to_vec(),
            Input::Word(end) => vec![self.bits() % end],
            Input::Bits => vec![self.bits()],
        }
    }

    fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((self.0 >> ((self.0 >> 28) + 4)) ^ self.0).wrapping_mul(277_803_737);
        word >> 22 ^ word
    }

    /// In [0, 1).
    fn uniform(&mut self) -> f32 {
        (self.bits() >> 8) as f32 / 16_777_216.0
    }

    fn number(&mut self) -> f32 {
        let magnitude = (32.0 * self.uniform() - 16.0).exp2();
        if self.bits() & 1 == 0 { magnitude } else { -magnitude }
    }

    fn fraction(&mut self) -> f32 {
        let near_zero = (-30.0 * self.uniform()).exp2();
        match self.bits() % 4 {
            0 => near_zero,
            1 => 1.0 - near_zero,
            _ => self.uniform(),
        }
    }

    fn direction(&mut self) -> [f32; 3] {
        loop {
            let mask = self.bits();
            // Each axis is left out once in eight times.
            let v =
                [0, 3, 6].map(|shift| if mask >> shift & 7 == 0 { 0.0 } else { 2.0 * self.uniform() - 1.0 });
            let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
            if length > 0.01 {
                return v.map(|x| x / length);
            }
        }
    }
}
