//! What the tests of this folder share.

use super::Variant;
use crate::layout::{Float, Intersector, Precision};

/// The variant of the default settings.
pub(super) const PLAIN: Variant = Variant {
    precision: Precision::F32,
    float: Float::Strict,
    intersector: Intersector::Watertight,
    aovs: false,
    stack_size: 16,
    bvh_stack: 24,
};
