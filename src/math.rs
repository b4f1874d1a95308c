//! Integer arithmetic that the stages share: named narrowing, named rounding, and positive reals as
//! a 32-bit mantissa with an exponent.
//!
//! Everything is integer and the same on every instruction set, so a picture does not depend on the
//! chip that drew it.

mod root;

pub(crate) use root::inverse_root;

use core::hint::black_box;
use core::num::NonZeroU32;
use core::ops::{Add, Shl};

/// `v / 2^n`, rounded to nearest, halves towards plus infinity. `n` is 0 to 62.
#[inline]
pub(crate) const fn shr_round(v: i64, n: u32) -> i64 {
    if n == 0 { v } else { ((v >> (n - 1)) + 1) >> 1 }
}

/// The nearest `i32`: what does not fit becomes the end of the range.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "clamped to the range first")]
pub(crate) const fn saturate(v: i64) -> i32 {
    if v > i32::MAX as i64 {
        i32::MAX
    } else if v < i32::MIN as i64 {
        i32::MIN
    } else {
        v as i32
    }
}

/// The low 32 bits, two's complement: for running values that wrap by intent, and for values whose
/// range is proved where it is called.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the low word is what is asked for")]
pub(crate) const fn low(v: i64) -> i32 {
    v as i32
}

/// The high 32 bits.
#[inline]
pub(crate) const fn high(v: u64) -> u32 {
    (v >> 32) as u32
}

/// An index from a coordinate; negative ones become an index that no slice has.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "by intent: from 2^31 on no slice has it")]
pub(crate) const fn index(v: i32) -> usize {
    v as usize
}

/// A count as a signed number. Counts are below 2^31.
#[inline]
#[expect(clippy::cast_possible_wrap, reason = "below 2^31")]
pub(crate) const fn bits(n: u32) -> i32 {
    n as i32
}

/// The same 32 bits as a signed number.
#[inline]
#[expect(clippy::cast_possible_wrap, reason = "the bits as they are")]
pub(crate) const fn signed(v: u32) -> i32 {
    v as i32
}

/// The same 32 bits as an unsigned number: a comparison with a bound is then also one with 0.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "the bits as they are")]
pub(crate) const fn unsigned(v: i32) -> u32 {
    v as u32
}

/// `p s - q t`, for `p` and `q` of at most `2^21` in magnitude.
#[inline]
pub(crate) fn cross(p: i32, s: i32, q: i32, t: i32) -> i64 {
    if SMALL_CORE {
        cross_split(p, s, q, t)
    } else {
        i64::from(p) * i64::from(s) - i64::from(q) * i64::from(t)
    }
}

/// [`cross`] in products of 32 bits, where one of 64 is a call of 37 instructions.
///
/// `p` and `q` in 11 bits and 10 above them, `s` and `t` in 16 and 16: a product takes 27 bits, a difference of two 28.
#[inline]
fn cross_split(p: i32, s: i32, q: i32, t: i32) -> i64 {
    let ([p1, p0], [q1, q0]) = ([p >> 11, p & 0x7ff], [q >> 11, q & 0x7ff]);
    let ([s1, s0], [t1, t0]) = ([s >> 16, s & 0xffff], [t >> 16, t & 0xffff]);
    let low = i64::from(p0 * s0 - q0 * t0) + (i64::from(p1 * s0 - q1 * t0) << 11);
    let high = i64::from(p0 * s1 - q0 * t1) + (i64::from(p1 * s1 - q1 * t1) << 11);
    low + (high << 16)
}

/// The high 32 bits of a product: `a b / 2^32`, floored.
#[inline]
pub(crate) fn high_product(a: i32, b: i32) -> i32 {
    low(product(a, b) >> 32)
}

/// First approximations of `2^40 / m` for `m` in `[2^31, 2^32)`, by the seven bits below the
/// leading one: `round(2^17 / (257 + 2 i)) - 256`, which is off by at most 1 part in 2^7.6.
const SEED: [u8; 128] = seed();

#[expect(clippy::cast_possible_truncation, reason = "entries are 0 to 254; a test recomputes them")]
#[expect(clippy::indexing_slicing, reason = "i is below the length; evaluated at compile time")]
const fn seed() -> [u8; 128] {
    let mut table = [0; 128];
    let mut i = 0;
    while i < 128 {
        let d = 257 + 2 * i as u32;
        table[i] = ((131_072 + d / 2) / d - 256) as u8;
        i += 1;
    }
    table
}

/// ARMv6-M: 32-bit products only, no count of leading zeros, no division; each is a call of 35 to 40
/// instructions there.
pub(crate) const SMALL_CORE: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));

/// `a b`.
#[inline]
pub(crate) const fn product(a: i32, b: i32) -> i64 {
    if SMALL_CORE { product_of_halves(a, b) } else { a as i64 * b as i64 }
}

/// [`product`] from four of 16 by 16 bits, where one of 64 bits is a call. No sum leaves 32 bits.
#[inline]
const fn product_of_halves(a: i32, b: i32) -> i64 {
    let ([a1, a0], [b1, b0]) = ([a >> 16, a & 0xffff], [b >> 16, b & 0xffff]);
    let low = unsigned(a0) * unsigned(b0);
    let middle = a0 * b1 + signed(low >> 16);
    let rest = a1 * b0 + (middle & 0xffff);
    let high = a1 * b1 + (middle >> 16) + (rest >> 16);
    (high as i64) << 32 | ((unsigned(rest) << 16) | (low & 0xffff)) as i64
}

/// `v` shifted left until its top bit is set, and by how much; 0 for 0, by 0 or 31.
#[inline]
pub(crate) fn normalized(v: u32) -> (u32, u32) {
    if SMALL_CORE {
        normalized_by_halves(v)
    } else {
        let zeros = v.leading_zeros() & 31;
        (v << zeros, zeros)
    }
}

/// [`normalized`] by comparisons: 17 instructions on ARMv6-M for 40.
#[inline]
fn normalized_by_halves(mut v: u32) -> (u32, u32) {
    /// Leading zeros of four bits, two bits each, from the least.
    const ZEROS: u32 = 0b00_00_00_00_00_00_00_00_01_01_01_01_10_10_11_11;
    let mut zeros = 0;
    for (bits, step) in [(16, 16), (24, 8), (28, 4)] {
        if v >> bits == 0 {
            v <<= step;
            zeros += step;
        }
    }
    let last = (ZEROS >> (2 * (v >> 28))) & 3;
    (v << last, zeros + last)
}

/// Q9 of `2^31 / m`, in (1/2, 1]: 9 bits, from the table.
#[inline]
fn seed_of(m: u32) -> u32 {
    256 + SEED.get(((m >> 24) & 0x7f) as usize).copied().map_or(0, u32::from)
}

/// The same without the table, where a division is an instruction.
#[inline]
fn seed_by_division(m: u32) -> u32 {
    let d = (m >> 23) | 1;
    (131_072 + d / 2).checked_div(d).unwrap_or(0)
}

/// `2^40 / m` for `m` in `[2^31, 2^32)`, to one part in 2^7.6: 2^8 to 2^9.
#[inline]
pub(crate) fn reciprocal_seed(m: u32) -> u32 {
    if SMALL_CORE { seed_of(m) } else { seed_by_division(m) }
}

/// `2^63 / m` for `m` in `[2^31, 2^32)` by a division of 32 by 16 bits, never below, and the Newton step of
/// [`reciprocal`].
#[inline]
pub(crate) fn reciprocal_by_division(m: u32) -> u32 {
    let x = u32::MAX.checked_div(m >> 16).unwrap_or(0);
    if SMALL_CORE { refined_split(x, m) } else { refined(x, m) }
}

/// `2^48 / m` for `m` in `[2^31, 2^32)`, to one part in 2^15: a seed of 9 bits, then a Newton
/// step. The result is in `[2^16, 2^17)`.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "2^16 to 2^17")]
pub(crate) fn reciprocal_estimate(m: u32) -> u32 {
    let x = bits(reciprocal_seed(m));
    // 1/2 - x f, with f = m / 2^32 cut to 16 bits: Q25, at most 2^17 + 2^9.
    let error = (1 << 24) - x * bits(m >> 16);
    // Q17: x + 2 x error.
    ((x << 8) + ((x * error) >> 16)) as u32
}

/// `2^63 / m` for `m` in `[2^31, 2^32)`: [`reciprocal_estimate`], then another Newton step.
///
/// The result is in `[2^31, 2^32)` and never off by more than one part in 2^29
/// (`reciprocal_is_close` in this file). No division: 32-bit cores without one run it as fast.
#[inline]
pub(crate) fn reciprocal(m: u32) -> u32 {
    let x = reciprocal_estimate(m);
    if SMALL_CORE { refined_split(x, m) } else { refined(x, m) }
}

/// [`reciprocal`] as one function, for what few triangles need.
#[inline(never)]
pub(crate) fn shared_reciprocal(m: u32) -> u32 {
    reciprocal(m)
}

/// The second Newton step: `x^2 m` against `x`, both in Q17.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "every m was tried: below 2^32")]
#[expect(clippy::cast_sign_loss, reason = "every m was tried: positive")]
fn refined(x: u32, m: u32) -> u32 {
    // Q49 with all of m: at most 2^33.
    let error = (1 << 48) - i64::from(x) * i64::from(m);
    ((i64::from(x) << 15) + ((i64::from(x) * error) >> 33)) as u32
}

/// [`refined`] in products of 32 bits: 25 instructions on ARMv6-M for 100. Every one of the 2^31 `m` was
/// tried: equal, and no step overflows but the first, which wraps.
///
/// The error is `high 2^15 + low`, `|high| <= 2^18` and `low < 2^15`; `x` is `x1 2^9 + x0`.
#[inline]
fn refined_split(x: u32, m: u32) -> u32 {
    // 2^33 - x (m >> 15), which fits, from its low 32 bits.
    let high = signed(x.wrapping_mul(m >> 15).wrapping_neg());
    let rest = x * (m & 0x7fff);
    let high = high - bits((rest + 0x7fff) >> 15);
    let low = rest.wrapping_neg() & 0x7fff;
    let sum = bits(x & 0x1ff) * high + bits((x * low) >> 15);
    let step = (bits(x >> 9) * high + (sum >> 9)) >> 9;
    // 2^31 to 2^32: the step may be negative.
    (x << 15).wrapping_add_signed(step)
}

/// Steps are counted to this.
pub(crate) const MOST_STEPS: i32 = 1 << STEP_BITS;

const STEP_BITS: u32 = 10;

/// How many times `step`, which is not negative, is to be added to `value` before it is 0 or more; at most `most`, which
/// is up to [`MOST_STEPS`]. By additions: `step` has 9 bits to spare.
#[inline(never)]
pub(crate) fn steps_to_zero<I>(mut value: I, step: I, most: i32) -> i32
where
    I: Copy + Default + PartialOrd + Add<Output = I> + Shl<u32, Output = I>,
{
    let zero = I::default();
    if value >= zero {
        return 0;
    }
    let mut last_below = 0;
    for bit in (0..STEP_BITS).rev() {
        let next = value + (step << bit);
        if next < zero {
            value = next;
            last_below += 1 << bit;
        }
        black_box(());
    }
    most.min(last_below + 1)
}

/// `2^41 / d`, floored, for `d` of more than 2^14 and less than 2^20: 21 to 27 bits.
#[inline]
pub(crate) fn inverse_area(d: NonZeroU32) -> u32 {
    if SMALL_CORE { inverse_by_reciprocal(d.get()) } else { inverse_by_digits(d) }
}

/// [`inverse_area`] by two divisions.
#[inline]
fn inverse_by_digits(d: NonZeroU32) -> u32 {
    let above = (1 << 31) / d;
    let rest = (1u32 << 31).wrapping_sub(above.wrapping_mul(d.get()));
    (above << 10) + (rest << 10) / d
}

/// The same without a division: a reciprocal is off by less than one here, so the remainder says which way.
#[inline]
fn inverse_by_reciprocal(d: u32) -> u32 {
    let (m, zeros) = normalized(d);
    let near = reciprocal(m) >> (22 - zeros);
    // 2^41 is 0 modulo 2^32.
    let rest = signed(near.wrapping_mul(d).wrapping_neg());
    near.wrapping_add_signed((rest >> 31) + i32::from(rest >= signed(d)))
}

/// `2^47 / m` for `m` in `[2^31, 2^32)`, 16 bits, never above it: `m` is rounded up to 17 bits, and the quotient down.
/// From `(2^31 - 1) / 2^16 - 1` to `2^16 - 1`, off by less than a part in `2^14` (`short_reciprocals_are_below` in this
/// file).
#[inline]
pub(crate) fn reciprocal_below(m: u32) -> i32 {
    let above = (m >> 16) + 1;
    if SMALL_CORE { quotient_by_steps(above) } else { signed(unsigned(i32::MAX) / above) }
}

/// `floor((2^31 - 1) / d)` for `d` of `2^15 + 1` to `2^16`, without a division. All were tried.
#[inline]
fn quotient_by_steps(d: u32) -> i32 {
    let rest = |x: i32| i32::MAX.wrapping_sub(x.wrapping_mul(signed(d)));
    // Within 2 or 3, then within 1.
    let x = signed(reciprocal_estimate((d << 16).wrapping_sub(1)) >> 1);
    let x = x + (((rest(x) >> 3) * x) >> 28);
    let left = rest(x);
    x + (left >> 31) + i32::from(left >= signed(d))
}

/// `a b / 2^17`, floored, for `b` of 16 bits: 0 to `2^16 - 1`.
#[inline]
pub(crate) const fn high_product_16(a: i32, b: i32) -> i32 {
    if SMALL_CORE { high_product_of_halves(a, b) } else { low((a as i64 * (b << 15) as i64) >> 32) }
}

/// [`high_product_16`] from two products of 16 by 16 bits.
#[inline]
const fn high_product_of_halves(a: i32, b: i32) -> i32 {
    let low = (unsigned(a) & 0xffff) * unsigned(b);
    ((a >> 16) * b + signed(low >> 16)) >> 1
}

/// A positive real `mantissa * 2^exponent` with `mantissa` in `[2^31, 2^32)`, or zero with mantissa
/// 0.
///
/// Every operation truncates or is off by less than one part in 2^29, so a product of three is
/// within 2^-27: the bound that the attribute and depth budgets are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scale {
    pub(crate) mantissa: u32,
    pub(crate) exponent: i32,
}

impl Scale {
    /// `2^exponent`.
    #[inline]
    pub(crate) const fn power_of_two(exponent: i32) -> Self {
        Self { mantissa: 1 << 31, exponent: exponent - 31 }
    }

    /// `v`, truncated to 32 bits of precision.
    #[inline]
    pub(crate) const fn of(v: u64) -> Self {
        if v == 0 {
            return Self { mantissa: 0, exponent: 0 };
        }
        let zeros = v.leading_zeros();
        Self { mantissa: high(v << zeros), exponent: 32 - bits(zeros) }
    }

    /// `1 / self`; of zero, the largest mantissa (callers exclude zero).
    #[inline]
    pub(crate) fn reciprocal(self) -> Self {
        Self { mantissa: reciprocal(self.mantissa), exponent: -63 - self.exponent }
    }

    /// [`Scale::of`], then [`Scale::reciprocal`], as one function.
    #[inline(never)]
    pub(crate) fn reciprocal_of(v: u64) -> Self {
        let Self { mantissa, exponent } = Self::of(v);
        Self { mantissa: shared_reciprocal(mantissa), exponent: -63 - exponent }
    }

    /// `self * other`, truncated.
    #[inline]
    pub(crate) const fn times(self, other: Self) -> Self {
        let product = self.mantissa as u64 * other.mantissa as u64;
        let exponent = self.exponent + other.exponent + 32;
        // The top bit is 62 or 63.
        if product >> 63 == 0 {
            Self { mantissa: high(product << 1), exponent: exponent - 1 }
        } else {
            Self { mantissa: high(product), exponent }
        }
    }

    /// `v * self * 2^fraction`, rounded to nearest (to one part in 2^62 and half a unit),
    /// saturating to `i64`. Not inlined: few triangles need it.
    #[inline(never)]
    #[expect(clippy::cast_possible_wrap, reason = "below 2^63 where it is cast")]
    #[expect(clippy::cast_sign_loss, reason = "a right shift of 1 to 64 where it is cast")]
    pub(crate) const fn apply(self, v: i64, fraction: i32) -> i64 {
        let magnitude = v.unsigned_abs();
        if magnitude == 0 || self.mantissa == 0 {
            return 0;
        }
        let zeros = magnitude.leading_zeros();
        // The high 64 of 96 bits.
        let normal = magnitude << zeros;
        let low = (normal & 0xffff_ffff) * self.mantissa as u64;
        let product = high(normal) as u64 * self.mantissa as u64 + high(low) as u64;
        let shift = bits(zeros) - 32 - self.exponent - fraction;
        let rounded = if shift < 1 {
            i64::MAX
        } else if shift > 64 {
            0
        } else {
            (((product >> (shift - 1) as u32) + 1) >> 1) as i64
        };
        if v < 0 { -rounded } else { rounded }
    }
}

/// A positive real `r`, made ready for products with edge functions at covered pixels, which it
/// bounds: `r e` is at most `2^B`, so `r` times all of `e` that matters is one product of 32 by 32 bits,
/// at a fixed shift.
///
/// With `r = m 2^x` and `m` in `[2^31, 2^32)`, `e' = e 2^(x + 62 - B)` is at most `2^62 / m <= 2^31`: one bit
/// to spare. `e'` is floored, so the product is off by less than `m 2^(B - 62) < 2^(B - 30)`, beside the
/// part in 2^29 that `r` is off.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factor {
    mantissa: u32,
    /// How far `e` is shifted right; left where it is negative. -62 to 63.
    shift: i32,
}

impl Factor {
    /// A real whose products are at most `2^whole_bits`.
    #[inline(never)]
    pub(crate) fn new(scale: Scale, whole_bits: i32) -> Self {
        let shift = -(scale.exponent + 62 - whole_bits);
        Self { mantissa: scale.mantissa, shift: shift.clamp(-62, 63) }
    }

    /// The product with `e`, in units of `2^(whole_bits - 61)`, floored; of a negative `e` 0, and beyond
    /// twice the bound saturated. Not inlined: few triangles need it.
    #[inline(never)]
    #[expect(clippy::cast_possible_wrap, reason = "a bit less than 64 where it is cast")]
    pub(crate) fn apply(self, e: i64) -> i64 {
        let e = e.max(0).unsigned_abs();
        let shift = self.shift.unsigned_abs();
        let e = if self.shift >= 0 { e >> (shift & 63) } else { e << (shift & 63) };
        ((u64::from(self.mantissa) * u64::from(u32::try_from(e).unwrap_or(u32::MAX))) >> 1) as i64
    }
}

/// A real with a sign.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Signed {
    pub(crate) negative: bool,
    pub(crate) scale: Scale,
}

impl Signed {
    /// `v`, truncated to 32 bits of precision. Not inlined, as all of these: few triangles need them.
    #[inline(never)]
    pub(crate) const fn of(v: i64) -> Self {
        Self { negative: v < 0, scale: Scale::of(v.unsigned_abs()) }
    }

    /// `self * scale`, truncated.
    #[inline(never)]
    pub(crate) const fn times(self, scale: Scale) -> Self {
        Self { scale: self.scale.times(scale), ..self }
    }

    /// In units of `2^(top - 30)`, for `top` at or above its exponent, floored towards 0.
    #[inline(never)]
    fn aligned(&self, top: i32) -> i64 {
        let drop = (top - self.scale.exponent).clamp(0, 63).unsigned_abs();
        let magnitude = (i64::from(self.scale.mantissa) << 30) >> drop;
        if self.negative { -magnitude } else { magnitude }
    }

    /// [`Scale::apply`] with the sign.
    #[inline(never)]
    pub(crate) const fn apply(self, v: i64, fraction: i32) -> i64 {
        let value = self.scale.apply(v, fraction);
        if self.negative { -value } else { value }
    }
}

/// Three reals as integers of at most 62 bits, and the exponent of their unit: exact but for what is
/// more than 31 bits below the largest, of which bits below 2^-61 of it are dropped.
#[inline(never)]
pub(crate) fn align(values: &[Signed; 3]) -> ([i64; 3], i32) {
    let mut top = None;
    for v in rolled(values) {
        if v.scale.mantissa != 0 {
            top = top.max(Some(v.scale.exponent));
        }
    }
    let top = top.unwrap_or(0);
    let [u, v, w] = values;
    ([u.aligned(top), v.aligned(top), w.aligned(top)], top - 30)
}

/// Adds `u v`. In place and not inlined: few triangles need it.
#[inline(never)]
fn add_product(sum: &mut i128, u: i64, v: i64) {
    *sum += i128::from(u) * i128::from(v);
}

/// The linear combination of three edge functions, or of their steps. Weights of at most 62 bits and
/// edges of at most 62 make at most 126.
#[inline(never)]
pub(crate) fn combine([u, v, w]: &[i64; 3], [x, y, z]: &[i64; 3]) -> i128 {
    let mut sum = 0;
    add_product(&mut sum, *u, *x);
    add_product(&mut sum, *v, *y);
    add_product(&mut sum, *w, *z);
    sum
}

/// The items, one after the other by a loop that is not unrolled: for what few triangles need.
#[inline]
pub(crate) fn rolled<T>(items: &[T]) -> impl Iterator<Item = &T> {
    // Of a known length it would be unrolled whole, with nothing that may have an effect by parts.
    black_box(items).iter().inspect(|_| black_box(()))
}

/// `v` as 64 bits and an exponent, floored.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "shifted into range")]
pub(crate) fn narrowed(v: i128) -> (i64, i32) {
    let shift = 65u32.saturating_sub(v.unsigned_abs().leading_zeros());
    ((v >> shift) as i64, bits(shift))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1000 spread values of `[2^31, 2^32)`, and the ends of every table entry.
    fn mantissas() -> impl Iterator<Item = u32> {
        let spread = (0..100_000u32).map(|i| (1 << 31) | i.wrapping_mul(2_654_435_769) >> 1);
        let ends = (0..128u32).flat_map(|i| {
            let first = (1 << 31) + (i << 24);
            [first, first + 1, first + ((1 << 24) - 1)]
        });
        spread.chain(ends)
    }

    #[test]
    fn reciprocal_is_close() {
        for m in mantissas() {
            let exact = (1u128 << 63) / u128::from(m);
            let r = u128::from(reciprocal(m));
            assert!(exact.abs_diff(r) << 29 <= exact, "1 / {m}: {r}, not {exact}");
        }
    }

    #[test]
    fn steps_are_counted() {
        for value in -40..5i64 {
            for step in 0..9 {
                for most in [0, 1, 7, MOST_STEPS] {
                    let steps = (0..most).find(|&n| value + step * i64::from(n) >= 0);
                    assert_eq!(steps_to_zero(value, step, most), steps.unwrap_or(most));
                }
            }
        }
        let most = i128::from(MOST_STEPS);
        assert_eq!(steps_to_zero(-most, 1, MOST_STEPS), MOST_STEPS);
        assert_eq!(steps_to_zero(-most + 1, 1, MOST_STEPS), MOST_STEPS - 1);
        assert_eq!(steps_to_zero(-3 << 61, 1i64 << 52, MOST_STEPS), MOST_STEPS);
    }

    #[test]
    fn seeds_by_division_are_the_tables() {
        for m in mantissas().chain([u32::MAX, u32::MAX - 1]) {
            assert_eq!(seed_by_division(m), seed_of(m), "{m}");
        }
    }

    #[test]
    fn reciprocals_of_small_cores_are_the_same() {
        for m in mantissas().chain([u32::MAX, u32::MAX - 1]) {
            let x = reciprocal_estimate(m);
            assert_eq!(refined_split(x, m), refined(x, m), "{m}");
            let exact = (1u64 << 48) / u64::from(m);
            assert!(exact.abs_diff(u64::from(x)) << 15 <= exact + (1 << 15), "{m}: {x}");
            assert!((1 << 16..1 << 17).contains(&x));
        }
    }

    /// All of them, both ways.
    #[test]
    fn inverse_areas_are_floored() {
        for d in (1 << 14) + 1..1 << 20 {
            let exact = u32::try_from((1u64 << 41) / u64::from(d)).unwrap();
            assert_eq!(inverse_by_digits(NonZeroU32::new(d).unwrap()), exact, "2^41 / {d}");
            assert_eq!(inverse_by_reciprocal(d), exact, "2^41 / {d}");
        }
    }

    #[test]
    fn short_reciprocals_are_below() {
        for d in (1 << 15) + 1..=1 << 16 {
            assert_eq!(quotient_by_steps(d), i32::MAX / d as i32, "{d}");
        }
        for m in mantissas().chain([u32::MAX, 1 << 31]) {
            let (exact, r) = (2f64.powi(47) / f64::from(m), f64::from(reciprocal_below(m)));
            assert!(r <= exact && (exact - r) * 2f64.powi(14) < exact, "{m}: {r}, not {exact}");
        }
    }

    #[test]
    fn short_products_of_halves_are_products() {
        for i in 0..100_000_i32 {
            let a = i.wrapping_mul(0x6789_abcd) >> (i % 31);
            let b = if i % 3 == 0 { 0xffff } else { i.wrapping_mul(40_503) & 0xffff };
            let exact = ((i64::from(a) * i64::from(b)) >> 17) as i32;
            assert_eq!((high_product_16(a, b), high_product_of_halves(a, b)), (exact, exact));
        }
    }

    #[test]
    fn products_of_halves_are_products() {
        let ends =
            [0, 1, -1, 0xffff, 0x1_0000, -0xffff, -0x1_0000, i32::MAX, i32::MIN, i32::MIN + 1];
        let spread = (0..500).map(|i: i32| i.wrapping_mul(0x6789_abcd) >> (i % 31));
        let all: std::vec::Vec<i32> = spread.chain(ends).collect();
        for &a in &all {
            for &b in &all {
                assert_eq!(product_of_halves(a, b), i64::from(a) * i64::from(b), "{a} {b}");
            }
        }
    }

    #[test]
    fn normalized_sets_the_top_bit() {
        for v in (0..32).flat_map(|n| [1 << n, (1 << n) | 1, (2u32 << n).wrapping_sub(1)]) {
            let zeros = v.leading_zeros();
            assert_eq!(normalized_by_halves(v), (v << zeros, zeros), "{v}");
            assert_eq!(normalized(v), (v << zeros, zeros), "{v}");
        }
        assert_eq!((normalized(0), normalized_by_halves(0)), ((0, 0), (0, 31)));
    }

    #[test]
    fn crosses_of_small_cores_are_the_same() {
        let narrow = [-(1 << 21), -(1 << 20), -77_777, -1, 0, 1, 2047, 2048, 1 << 20, 1 << 21];
        let wide = [i32::MIN, -(1 << 20), -65_537, -1, 0, 1, 65_535, 65_536, 1 << 30, i32::MAX];
        for i in 0..10_000usize {
            let at = |n: u32| i / 10usize.pow(n) % 10;
            let (p, s, q, t) = (narrow[at(0)], wide[at(1)], narrow[at(2)], wide[at(3)]);
            let exact = i64::from(p) * i64::from(s) - i64::from(q) * i64::from(t);
            assert_eq!((cross(p, s, q, t), cross_split(p, s, q, t)), (exact, exact));
        }
    }

    #[test]
    fn shr_round_rounds_to_nearest() {
        assert_eq!(shr_round(5, 1), 3);
        assert_eq!(shr_round(-5, 1), -2);
        assert_eq!(shr_round(i64::MAX, 62), 2);
        assert_eq!(shr_round(i64::MIN, 62), -2);
        assert_eq!(shr_round(7, 0), 7);
    }

    #[test]
    fn apply_agrees_with_wide_arithmetic() {
        for (i, m) in mantissas().enumerate().take(5000) {
            let v = (i64::from(m) * 77_777).wrapping_mul(i as i64 | 1) >> (i % 60);
            let scale = Scale { mantissa: m, exponent: -31 - (i as i32 % 40) };
            for fraction in [-4, 0, 12, 40] {
                let shift = -(scale.exponent + fraction);
                let exact = i128::from(v) * i128::from(m);
                let exact = if shift >= 0 { exact >> shift.min(127) } else { exact << -shift };
                let got = i128::from(scale.apply(v, fraction));
                if exact.unsigned_abs() < 1 << 62 {
                    assert!(
                        exact.abs_diff(got) <= 1 + (exact.unsigned_abs() >> 61),
                        "{v} x {scale:?} at {fraction}: {got}, not {exact}"
                    );
                } else {
                    assert!(got.unsigned_abs() >= 1 << 61);
                }
            }
        }
    }

    #[test]
    fn factors_agree_with_the_scales_they_are_made_of() {
        for (i, m) in mantissas().enumerate().take(20_000) {
            let scale = Scale { mantissa: m, exponent: -62 + (i as i32 % 60) };
            for whole_bits in [0, 34] {
                // All edge functions whose products are at most 2^whole_bits.
                let largest = Scale::power_of_two(whole_bits).apply(1, 0);
                let e = scale.reciprocal().apply(largest, 0) / (1 + i as i64 % 7);
                if e == i64::MAX {
                    continue;
                }
                let exact = i128::from(e) * i128::from(m);
                let shift = -(scale.exponent + 61 - whole_bits);
                let exact = if shift >= 0 { exact >> shift.min(127) } else { exact << -shift };
                let got = i128::from(Factor::new(scale, whole_bits).apply(e));
                // Units are 2^(whole_bits - 61): one part in 2^30 of the bound, floored.
                let off = exact - got;
                assert!((-1..=1 << 31).contains(&off), "{scale:?} x {e}: {got}, not {exact}");
                assert_eq!(Factor::new(scale, whole_bits).apply(-e), 0);
            }
        }
    }

    #[test]
    fn apply_saturates_and_vanishes() {
        assert_eq!(Scale::power_of_two(20).apply(1 << 50, 0), i64::MAX);
        assert_eq!(Scale::power_of_two(20).apply(-(1 << 50), 0), -i64::MAX);
        assert_eq!(Scale::power_of_two(-80).apply(i64::MIN, 0), 0);
        assert_eq!(Scale::power_of_two(-64).apply(i64::MIN, 0), -1);
        assert_eq!(Scale::of(0).apply(99, 30), 0);
        assert_eq!(Scale::power_of_two(3).apply(5, 1), 80);
    }

    #[test]
    fn scales_multiply_and_invert() {
        let third = Scale::of(3).reciprocal();
        assert_eq!(third.apply(3 << 20, 0), 1 << 20);
        assert_eq!(third.times(Scale::of(9)).apply(1 << 20, 0), 3 << 20);
        assert_eq!(Scale::of(u64::MAX).apply(1, -40), 1 << 24);
    }

    #[test]
    fn aligned_values_keep_sign_and_ratio() {
        let values = [Signed::of(3), Signed::of(-5), Signed::of(7).times(Scale::power_of_two(40))];
        let ([a, b, c], exponent) = align(&values);
        assert_eq!(c, 7 << (40 - exponent));
        let [a, b, c] = [a, b, c].map(i128::from);
        assert_eq!((a * 5, c), (-b * 3, (a << 40) / 3 * 7));
        let ([zero, _, top], _) = align(&[Signed::of(0), Signed::of(1), Signed::of(i64::MIN)]);
        assert_eq!((zero, top), (0, -(1 << 61)));
    }

    #[test]
    fn narrowed_values_keep_63_bits() {
        for v in [0, 1, -1, i128::from(i64::MAX), i128::from(i64::MIN), 3 << 100, -(5 << 120)] {
            let (n, exponent) = narrowed(v);
            assert_eq!(i128::from(n) << exponent, v, "{v}");
        }
        let (n, exponent) = narrowed(i128::MIN + 1);
        assert_eq!((n, exponent), (i64::MIN, 64));
    }
}
