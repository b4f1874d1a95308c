//! Why a scene was not drawn.

use hither::{BufferSize, DepthSize, HitherDistance, MatrixError, MeshError, ViewportSize};

/// What was lent does not hold the picture, or a matrix left its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneError {
    /// Too few words of colour or depth.
    Buffer(BufferSize),
    /// The depth buffer is not the size of the target.
    Depth(DepthSize),
    /// A side of the picture is 0 or too long.
    Viewport(ViewportSize),
    /// A matrix entry left its range.
    Matrix(MatrixError),
    /// The hither plane is not in front of the eye.
    Hither(HitherDistance),
    /// A mesh's data do not fit together.
    Mesh(MeshError),
}

impl core::fmt::Display for SceneError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Buffer(error) => error.fmt(f),
            Self::Depth(error) => error.fmt(f),
            Self::Viewport(error) => error.fmt(f),
            Self::Matrix(error) => error.fmt(f),
            Self::Hither(error) => error.fmt(f),
            Self::Mesh(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for SceneError {}

impl From<BufferSize> for SceneError {
    fn from(error: BufferSize) -> Self {
        Self::Buffer(error)
    }
}

impl From<DepthSize> for SceneError {
    fn from(error: DepthSize) -> Self {
        Self::Depth(error)
    }
}

impl From<ViewportSize> for SceneError {
    fn from(error: ViewportSize) -> Self {
        Self::Viewport(error)
    }
}

impl From<MatrixError> for SceneError {
    fn from(error: MatrixError) -> Self {
        Self::Matrix(error)
    }
}

impl From<HitherDistance> for SceneError {
    fn from(error: HitherDistance) -> Self {
        Self::Hither(error)
    }
}

impl From<MeshError> for SceneError {
    fn from(error: MeshError) -> Self {
        Self::Mesh(error)
    }
}
