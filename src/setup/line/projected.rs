//! Setup of a line between two projected vertices: [`Segment`](super::Segment) with the `w` of both divided out, in 32 bits.
//!
//! With `(u, v)` in subpixels, `span = B.u - A.u` and `climb = B.v - A.v`, the line is at `A.v span + (U - A.u) climb` over
//! `span` at the centre `U` of a step. A step adds whole pixels to `U`; so counted in pixels, and floored, that grows by
//! `climb`, and from row to row by `span`. Where `v` falls along it, rows are
//! counted the other way, `-1 - v`.
//!
//! | value | bound | why |
//! | --- | --- | --- |
//! | `u`, `v` | 2^18 | the guard band, at 8 subpixel bits |
//! | `span`, `climb` | 2^19 | |
//! | `A.v span + (U - A.u) climb`, from the row of `A` and at its own step | 2^27 + 2^26 | less than a pixel each way |
//! | what is left of a row | 2^19 | below `span` |
//! | steps, and rows | 1536 | from the guard band's end over a viewport |
//! | steps times `climb`, and rows times `span` | 2^29.6 | |

/// A line between two projected vertices, in order along its major axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProjectedLine {
    /// Whether the major axis is `y`.
    pub(crate) steep: bool,
    /// Whether the vertices are in another order than they came in.
    pub(crate) exchanged: bool,
    /// Whether `v` falls along the line: then rows are `-1 - v`.
    pub(crate) falls: bool,
    /// In subpixels: `span` is positive, `climb` from 0 to `span`.
    pub(crate) span: i32,
    pub(crate) climb: i32,
    /// The steps from the pixel of one end to that of the other, both included.
    pub(crate) from: i32,
    pub(crate) to: i32,
    /// The row at the first step, and what is left above it: from 0 to before `span`.
    pub(crate) row: i32,
    pub(crate) rest: i32,
    /// No row is outside of these: at an end's step the line may be half a pixel beyond the end.
    pub(crate) rows: [i32; 2],
    /// Subpixels from the first end to the centre of its step: up to half a pixel.
    pub(crate) offset: i32,
}

impl ProjectedLine {
    /// From corners in subpixels of `bits` bits; `None` where both are the same.
    #[inline(always)]
    pub(crate) fn new([a, b]: [[i32; 2]; 2], bits: u32) -> Option<Self> {
        let ([ax, ay], [bx, by]) = (a, b);
        let (across, down) = (bx - ax, by - ay);
        let steep = down.abs() > across.abs();
        let (span, climb) = if steep { (down, across) } else { (across, down) };
        if span == 0 {
            return None;
        }
        let exchanged = span < 0;
        let ends = if steep { [[ay, ax], [by, bx]] } else { [a, b] };
        let [p, q] = ends;
        let [[u, v], [last_u, last_v]] = if exchanged { [q, p] } else { [p, q] };
        let (span, climb) = if exchanged { (-span, -climb) } else { (span, climb) };
        let (from, first_row, last_row) = (u >> bits, v >> bits, last_v >> bits);
        let offset = (from << bits) + (1 << (bits - 1)) - u;
        // Within half a row of the first end's.
        let within = ((v - (first_row << bits)) * span + offset * climb) >> bits;
        let (row, rest) = if within < 0 {
            (first_row - 1, within + span)
        } else if within >= span {
            (first_row + 1, within - span)
        } else {
            (first_row, within)
        };
        let falls = climb < 0;
        let (row, rest, climb) =
            if falls { (!row, span - 1 - rest, -climb) } else { (row, rest, climb) };
        let rows =
            if falls { [!first_row - 1, !last_row + 1] } else { [first_row - 1, last_row + 1] };
        let to = (last_u >> bits) + 1;
        Some(Self { steep, exchanged, falls, span, climb, from, to, row, rest, rows, offset })
    }
}
