//! Normals for what has none: the mean of the faces round a position, by their areas.

use crate::obj::Obj;

/// A normal for each position, of length 1, or 0 where its faces have no area together.
///
/// A face adds its vector area (Newell's sum over its edges), so that how it is cut into triangles changes nothing. Faces share a
/// position where the file says so: an edge is kept sharp by giving its positions twice.
pub(crate) fn of_faces(obj: &Obj, scale: f64) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; obj.positions.len()];
    for face in &obj.faces {
        let at = |i: usize| {
            let corner = &face.corners[i % face.corners.len()];
            obj.positions[corner.position].at.map(|v| v * scale)
        };
        let first = at(0);
        let mut area = [0.0; 3];
        for i in 1..face.corners.len() {
            let [a, b] = [at(i), at(i + 1)].map(|p| [0, 1, 2].map(|axis| p[axis] - first[axis]));
            area[0] += a[1] * b[2] - a[2] * b[1];
            area[1] += a[2] * b[0] - a[0] * b[2];
            area[2] += a[0] * b[1] - a[1] * b[0];
        }
        for corner in &face.corners {
            let sum = &mut sums[corner.position];
            *sum = [0, 1, 2].map(|axis| sum[axis] + area[axis]);
        }
    }
    sums.into_iter().map(|sum| unit(sum).unwrap_or_default()).collect()
}

/// A vector of any finite size at length 1; `None` for one without a direction.
pub(crate) fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let largest = vector.iter().fold(0.0, |largest: f64, v| largest.max(v.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return None;
    }
    // Divided first, so that no square overflows or vanishes.
    let vector = vector.map(|v| v / largest);
    let length = vector.iter().map(|v| v * v).sum::<f64>().sqrt();
    Some(vector.map(|v| v / length))
}
