//! How many processor clocks something takes, by SysTick.

use core::fmt;
use core::sync::atomic::{AtomicU32, Ordering};
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::exception;

/// What SysTick counts down from: it has 24 bits, and 2^24 clocks are 0.3 s at 50 MHz.
const RELOAD: u32 = (1 << 24) - 1;

/// How often SysTick ran out: bits 31:24 of the count, which wraps after 86 s.
static WRAPS: AtomicU32 = AtomicU32::new(0);

#[exception]
fn SysTick() {
    WRAPS.fetch_add(1, Ordering::Relaxed);
}

/// SysTick, counting the processor's clocks.
pub struct Cycles(());

impl Cycles {
    /// Starts the counter.
    pub fn start(mut counter: SYST) -> Self {
        counter.set_clock_source(SystClkSource::Core);
        counter.set_reload(RELOAD);
        counter.clear_current();
        counter.enable_interrupt();
        counter.enable_counter();
        Self(())
    }

    /// Does something; its result, and how many clocks it took, up to 2^32.
    pub fn count<R>(&mut self, work: impl FnOnce() -> R) -> (R, u32) {
        let start = now();
        let result = work();
        (result, now().wrapping_sub(start))
    }
}

/// Clocks since the start, modulo 2^32.
fn now() -> u32 {
    loop {
        let wraps = WRAPS.load(Ordering::Relaxed);
        let left = SYST::get_current();
        // If it ran out in between, `left` may be of either side.
        if wraps == WRAPS.load(Ordering::Relaxed) {
            return (wraps << 24) + (RELOAD - left);
        }
    }
}

/// What a frame took, as a line of text: `frame 3: draw 123456, send 7890 cycles`.
#[derive(Clone, Copy, Debug)]
pub struct Report {
    /// The frame's number.
    pub number: u32,
    /// Clocks to draw it.
    pub draw: u32,
    /// Clocks to send it to the panel.
    pub send: u32,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { number, draw, send } = self;
        write!(f, "frame {number}: draw {draw}, send {send} cycles")
    }
}
