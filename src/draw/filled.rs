//! Shapes on the screen, filled.

use super::Frame;
use crate::blend::Alpha;
use crate::depth::DepthTest;
use crate::framebuffer::Target;
use crate::shape::{self, Shape};

impl<C: Target, D: DepthTest, W, T, I, const P: usize> Frame<C, D, W, T, I, P> {
    /// Fills a shape on the screen with one colour: the pixels whose centres are inside, or on a left or top edge, as a triangle
    /// of the tier [`Quick<8>`](crate::Quick) has them. Shapes that share an edge neither gap nor overlap. Depth is neither looked
    /// at nor stored.
    pub fn fill_shape(&mut self, shape: &impl Shape, color: C::Color) {
        let (window, origin) = (self.known_window(), self.origin());
        shape::fill(&mut self.target, &shape.polygon(), window, origin, color);
    }

    /// Fills a shape on the screen with smooth edges: pixels that an edge cuts take the share of them that is inside, within 1 %
    /// of a pixel. The target merges: see [`Frame::blended`] and [`Over`](crate::Over).
    ///
    /// ```
    /// use hither::{Alpha, Frame, Framebuffer, Gray8, I16F16, Triangle};
    ///
    /// let mut words = [0; 64];
    /// let mut frame = Frame::new(Framebuffer::<Gray8>::try_new(&mut words, 8, 8)?)?;
    /// let corners = [[0.0, 7.5], [8.0, 7.5], [4.5, 0.0]].map(|p| p.map(I16F16::from_num));
    /// frame.blended().fill_shape_smooth(&Triangle(corners), Alpha { color: Gray8::WHITE, alpha: 255 });
    /// let shown = |word: &u8| b" .:-=+*#%@"[usize::from(*word) * 9 / 255] as char;
    /// let rows: Vec<String> = words.chunks(8).map(|row| row.iter().map(shown).collect()).collect();
    /// assert_eq!(rows, [
    ///     "    =   ",
    ///     "   -@.  ",
    ///     "   %@*  ",
    ///     "  +@@%. ",
    ///     " .%@@@+ ",
    ///     " #@@@@% ",
    ///     "-@@@@@@=",
    ///     "-======-",
    /// ]);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn fill_shape_smooth<K: Copy>(&mut self, shape: &impl Shape, color: Alpha<K>)
    where
        C: Target<Color = Alpha<K>>,
    {
        let window = self.known_window();
        let origin = self.origin();
        shape::fill_smooth(&mut self.target, &shape.polygon(), window, origin, color);
    }
}
