//! What a planner is told of a scene: bounds on what is drawn, and how far off it may be.

/// The bounds of a scene, and an error budget: what [`Plan::new`](super::Plan::new) plans from.
///
/// Bounds are on the triangles that are drawn, all of whose vertices are at `near` or beyond and within 1024 pixels of the
/// viewport's top left corner. (Others are drawn as well; what is promised is not about them.) What is not said has a default:
/// no texture, no colours, any `w` within a triangle, and a budget of a quarter of a pixel, a texel, a step and a half of
/// RGB565 and a step of a 16-bit depth.
///
/// ```
/// use hither::{Plan, Scene};
///
/// const ROOM: Plan = Plan::new(
///     Scene::new(240, 240).range(1.0, 40.0).model(2.0, 2.0).triangle(0.2, f32::INFINITY).texture(64, 0.25),
/// );
/// // A straight line over a triangle is within a texel of perspective.
/// assert_eq!((ROOM.snap_bits, ROOM.every, ROOM.depth_bits), (4, 0, 16));
/// assert!(ROOM.promise.texels < 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Scene {
    /// The viewport's width in pixels, 1 to 512.
    pub width: u32,
    /// Its height.
    pub height: u32,
    /// The least `w` of a vertex: the hither distance, or a little beyond it, as a transform rounds.
    pub near: f32,
    /// The largest `w` of a vertex, below 32768.
    pub far: f32,
    /// The largest coordinate of a model, from its origin, in its units.
    pub extent: f32,
    /// How far a model's unit may reach in clip space: the largest sum of the magnitudes of three entries of a row, of the left
    /// three columns of the whole matrix.
    pub stretch: f32,
    /// By how much `w` differs over one triangle, at the most.
    pub deep: f32,
    /// By what part of itself `w` changes from a pixel of a triangle to the next of its row, at the most: 0 where a camera
    /// that is level looks at a floor.
    pub tilt: f32,
    /// The longest side of a texture in texels, up to 4096; 0 where there is none.
    pub texture: u32,
    /// By how much a texture coordinate differs over one triangle, at the most.
    pub repeats: f32,
    /// The largest magnitude of a texture coordinate, up to 127.
    pub coordinate: f32,
    /// Whether there are colours from the vertices.
    pub colors: bool,
    /// How far from its place a vertex that is on the screen may be, along x or y, in pixels.
    pub pixels: f32,
    /// How far from its place a texture coordinate may be, along u or v, in texels.
    pub texels: f32,
    /// How far off a colour channel may be, in steps of RGB565, of which rounding alone takes half of one.
    pub color_steps: f32,
    /// How far off a depth may be, in steps of 16 bits.
    pub depth_steps: f32,
}

impl Scene {
    /// On a viewport of `width x height` pixels, with all else at its default: `w` from 1 to 64, a model of 1 unit.
    #[must_use]
    pub const fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            near: 1.0,
            far: 64.0,
            extent: 1.0,
            stretch: 2.0,
            deep: f32::INFINITY,
            tilt: f32::INFINITY,
            texture: 0,
            repeats: 0.0,
            coordinate: 0.0,
            colors: false,
            pixels: 0.25,
            texels: 1.0,
            color_steps: 1.5,
            depth_steps: 1.1,
        }
    }

    /// Its [`near`](Self::near) and [`far`](Self::far).
    #[must_use]
    pub const fn range(self, near: f32, far: f32) -> Self {
        Self { near, far, ..self }
    }

    /// Its models' [`extent`](Self::extent) and [`stretch`](Self::stretch).
    #[must_use]
    pub const fn model(self, extent: f32, stretch: f32) -> Self {
        Self { extent, stretch, ..self }
    }

    /// Its triangles, [`deep`](Self::deep) and [`tilt`](Self::tilt).
    #[must_use]
    pub const fn triangle(self, deep: f32, tilt: f32) -> Self {
        Self { deep, tilt, ..self }
    }

    /// [`Textures`](Self::texture) of a side in texels, and their [`repeats`](Self::repeats), with coordinates from `-repeats`
    /// to `repeats`: where they are others, [`coordinates`](Self::coordinates) comes after this.
    #[must_use]
    pub const fn texture(self, side: u32, repeats: f32) -> Self {
        Self { texture: side, repeats, coordinate: repeats, ..self }
    }

    /// The largest magnitude of a texture [`coordinate`](Self::coordinate).
    #[must_use]
    pub const fn coordinates(self, largest: f32) -> Self {
        Self { coordinate: largest, ..self }
    }

    /// With [`colours`](Self::colors) at the vertices.
    #[must_use]
    pub const fn colors(self) -> Self {
        Self { colors: true, ..self }
    }

    /// With a budget in [`pixels`](Self::pixels).
    #[must_use]
    pub const fn within_pixels(self, pixels: f32) -> Self {
        Self { pixels, ..self }
    }

    /// With a budget in [`texels`](Self::texels).
    #[must_use]
    pub const fn within_texels(self, texels: f32) -> Self {
        Self { texels, ..self }
    }

    /// With a budget in [`steps of a colour`](Self::color_steps).
    #[must_use]
    pub const fn within_color_steps(self, color_steps: f32) -> Self {
        Self { color_steps, ..self }
    }

    /// With a budget in [`steps of depth`](Self::depth_steps).
    #[must_use]
    pub const fn within_depth_steps(self, depth_steps: f32) -> Self {
        Self { depth_steps, ..self }
    }
}
