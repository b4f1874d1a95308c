//! The points: every knob turned by itself from what most scenes take, and the tiers with every correction.

use super::knobs::{Knobs, Of, PresetPoint};
use hither::{
    Affine, Balance, Dithered, DividedBy, Division, Exact, Fidelity, Float, Gouraud, Mat4, Newton,
    NoDepth, Packed, Perspective, PerspectiveEvery, Quick, ShortMat4, Speed, Table, Wide,
};

/// What is done with each point.
pub trait Visitor {
    /// Does it with one.
    fn visit<K: Knobs>(&mut self);
}

type Q4 = Quick<4>;
type Q8 = Quick<8>;
type Every<const N: u8> = PerspectiveEvery<N>;

macro_rules! visit {
    ($visitor:ident: $($point:ty),* $(,)?) => { $( $visitor.visit::<$point>(); )* };
}

/// The points that say most: presets, and each knob at its ends.
pub fn quick(v: &mut impl Visitor) {
    visit! { v:
        PresetPoint<Speed>,
        PresetPoint<Balance>,
        PresetPoint<Fidelity>,
        Of<Q8, Packed<Affine>>,
        Of<Q8, Affine>,
        Of<Q8, Perspective>,
        Of<Q8, Every<8>>,
        Of<Q8, Every<16>>,
        Of<Q4, Packed<Affine>>,
        Of<Q8, Wide<Every<8>>>,
        Of<Q4, Packed<Every<8>>>,
        Of<Q4, Perspective>,
        Of<Exact, Affine>,
        Of<Exact, Every<8>>,
        Of<Q8, DividedBy<Every<8>, Table>>,
        Of<Q8, Packed<DividedBy<Every<8>, Table>>>,
        Of<Q8, Packed<DividedBy<Every<8>, Newton<1>>>>,
        Of<Q8, Packed<Every<8>>, NoDepth>,
        Of<Q8, Packed<Every<8>>, u32>,
        Of<Q8, Packed<Every<8>>, u16, ShortMat4>,
        Of<Q8, Packed<Every<8>>, u16, Mat4, Dithered<Gouraud>>,
        Of<Exact, Perspective, u16, Mat4, Dithered<Gouraud>>,
    }
}

/// All others.
pub fn more(v: &mut impl Visitor) {
    visit! { v:
        Of<Q4, Affine>,
        Of<Q4, Every<8>>,
        Of<Q4, Every<16>>,
        Of<Q4, Every<32>>,
        Of<Q4, Packed<Every<16>>>,
        Of<Q4, Packed<Every<32>>>,
        Of<Q8, Every<32>>,
        Of<Q8, Packed<Every<16>>>,
        Of<Q8, Packed<Perspective>>,
        Of<Q8, Wide<Affine>>,
        Of<Q8, Wide<Perspective>>,
        Of<Exact, Every<16>>,
        Of<Exact, Every<32>>,
        Of<Exact, Wide<Perspective>>,
        Of<Q8, DividedBy<Every<8>, Newton<1>>>,
        Of<Q8, DividedBy<Every<8>, Division>>,
        Of<Q8, DividedBy<Every<8>, Float>>,
        Of<Q8, Packed<DividedBy<Every<8>, Division>>>,
        Of<Q8, Packed<DividedBy<Every<8>, Float>>>,
        Of<Q8, DividedBy<Perspective, Table>>,
        Of<Q8, DividedBy<Perspective, Newton<1>>>,
        Of<Exact, DividedBy<Perspective, Table>>,
        Of<Exact, DividedBy<Perspective, Float>>,
        Of<Q4, Packed<Affine>, NoDepth>,
        Of<Exact, Perspective, NoDepth>,
        Of<Exact, Perspective, u32>,
        Of<Q4, Packed<Affine>, u16, ShortMat4>,
        Of<Exact, Perspective, u16, ShortMat4>,
        Of<Q8, Perspective, u16, Mat4, Dithered<Gouraud>>,
        Of<Q4, Packed<Affine>, NoDepth, ShortMat4>,
    }
}
