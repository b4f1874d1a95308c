//! How deep the stack went: it is painted, and looked at afterwards.

/// What unused stack is painted with.
const PAINT: u32 = 0xc0de_57ac;

/// Words just below the stack pointer that are left to the painting itself, which has no calls in it.
const SPARED: usize = 16;

/// A painted stack.
#[derive(Debug)]
pub struct Painted {
    /// The stack pointer when it was painted.
    top: *mut u32,
    words: usize,
}

/// Paints some words of the stack below the caller's frame: more than is looked for takes, less than there are above the
/// static variables.
#[inline(always)]
pub fn paint(words: usize) -> Painted {
    let top = pointer();
    for word in SPARED..words {
        // SAFETY: below the stack pointer nothing lives, interrupts are off, and there are so many words by contract.
        unsafe { top.wrapping_sub(word).write_volatile(PAINT) };
    }
    Painted { top, words }
}

impl Painted {
    /// Bytes below the stack pointer of then that were written since, at least 64; `None` where it was more than was
    /// painted.
    #[inline(always)]
    pub fn deepest(&self) -> Option<u32> {
        // SAFETY: as in `paint`.
        let is_painted =
            |word: usize| unsafe { self.top.wrapping_sub(word).read_volatile() } == PAINT;
        let mut deepest = self.words - 1;
        if !is_painted(deepest) {
            return None;
        }
        while deepest >= SPARED && is_painted(deepest) {
            deepest -= 1;
        }
        Some(4 * deepest as u32)
    }
}

/// The stack pointer.
#[inline(always)]
fn pointer() -> *mut u32 {
    let pointer: *mut u32;
    // SAFETY: a read of a register.
    #[cfg(target_arch = "arm")]
    unsafe {
        core::arch::asm!("mov {}, sp", out(reg) pointer);
    }
    // SAFETY: a read of a register.
    #[cfg(target_arch = "riscv32")]
    unsafe {
        core::arch::asm!("mv {}, sp", out(reg) pointer);
    }
    pointer
}
