//! A record of words, read and written one after the other. Twin of shaders/probe.wgsl.

use crate::kernel::Vec3;

pub(super) struct Record {
    inputs: Vec<u32>,
    reading: usize,
    outputs: Vec<Output>,
}

/// A word that a function wrote.
#[derive(Debug, Clone, Copy)]
pub(super) enum Output {
    /// Bits of a number.
    Number(u32),
    /// Compared as it is.
    Word(u32),
}

impl Output {
    /// Whether an adapter wrote the same. Devices may flush subnormal numbers, as the film does, and the sign of zero
    /// never decides anything: all these are one.
    fn is(self, found: u32) -> bool {
        let is_tiny = |bits: u32| f32::from_bits(bits).abs() < f32::MIN_POSITIVE;
        match self {
            Self::Number(bits) => bits == found || (is_tiny(bits) && is_tiny(found)),
            Self::Word(word) => word == found,
        }
    }
}

impl Record {
    pub(super) fn new(inputs: &[u32]) -> Self {
        Self { inputs: inputs.to_vec(), reading: 0, outputs: Vec::new() }
    }

    pub(super) fn take_word(&mut self) -> u32 {
        self.reading += 1;
        self.inputs[self.reading - 1]
    }

    pub(super) fn take(&mut self) -> f32 {
        f32::from_bits(self.take_word())
    }

    pub(super) fn take3(&mut self) -> Vec3<f32> {
        let (x, y, z) = (self.take(), self.take(), self.take());
        Vec3::new(x, y, z)
    }

    pub(super) fn put_word(&mut self, word: u32) {
        self.outputs.push(Output::Word(word));
    }

    pub(super) fn put(&mut self, x: f32) {
        self.outputs.push(Output::Number(x.to_bits()));
    }

    pub(super) fn put3(&mut self, v: Vec3<f32>) {
        [v.x, v.y, v.z].into_iter().for_each(|x| self.put(x));
    }

    pub(super) fn put_flag(&mut self, flag: bool) {
        self.put_word(u32::from(flag));
    }

    pub(super) fn outputs(&self) -> &[Output] {
        &self.outputs
    }

    /// Whether an adapter wrote the same.
    pub(super) fn is_same(&self, found: &[u32]) -> bool {
        self.outputs.iter().zip(found).all(|(output, found)| output.is(*found))
    }
}
