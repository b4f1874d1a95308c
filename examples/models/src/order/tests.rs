use super::*;

/// A grid of `n x n` squares, its triangles shuffled.
fn shuffled_grid(n: u16) -> (Vec<[u16; 3]>, usize) {
    let at = |x: u16, y: u16| y * (n + 1) + x;
    let mut grid: Vec<[u16; 3]> = (0..n * n)
        .flat_map(|i| {
            let (x, y) = (i % n, i / n);
            [[at(x, y), at(x + 1, y), at(x, y + 1)], [at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)]]
        })
        .collect();
    let mut state = 1_u64;
    for i in (1..grid.len()).rev() {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        grid.swap(i, (state >> 33) as usize % (i + 1));
    }
    (grid, usize::from(n + 1).pow(2))
}

/// Vertices that a first-in, first-out cache of 16 does not hold when they are read, a triangle.
fn misses(triangles: &[[u16; 3]]) -> f64 {
    let mut held = std::collections::VecDeque::new();
    let mut misses = 0;
    for vertex in triangles.iter().flatten() {
        if !held.contains(vertex) {
            misses += 1;
            held.push_back(*vertex);
            if held.len() > 16 {
                held.pop_front();
            }
        }
    }
    f64::from(misses) / triangles.len() as f64
}

#[test]
fn triangles_are_the_same_in_an_order_that_uses_vertices_again() {
    let (grid, count) = shuffled_grid(40);
    let ordered = triangles(&grid, count);
    let sorted = |triangles: &[[u16; 3]]| {
        let mut sorted = triangles.to_vec();
        sorted.sort_unstable();
        sorted
    };
    assert_eq!(sorted(&ordered), sorted(&grid));
    assert!(
        misses(&grid) > 2.5 && misses(&ordered) < 0.75,
        "{} {}",
        misses(&grid),
        misses(&ordered)
    );
}

#[test]
fn odd_meshes_are_ordered_too() {
    assert_eq!(triangles(&[], 0), [[0; 3]; 0]);
    assert_eq!(triangles(&[], 3), [[0; 3]; 0]);
    // A vertex twice, vertices that nothing uses, parts that do not touch, and the highest number.
    let odd = [[9, 9, 4], [0, 1, 2], [65535, 7, 8], [0, 1, 2]];
    let mut ordered = triangles(&odd, 65536);
    ordered.sort_unstable();
    assert_eq!(ordered, [[0, 1, 2], [0, 1, 2], [9, 9, 4], [65535, 7, 8]]);
    let numbers = vertices(&odd, 65536);
    assert_eq!(numbers, [9, 0, 1, 2, 4, 65535, 7, 8]);
    assert_eq!(renumber(&odd, &numbers), [[0, 0, 4], [1, 2, 3], [5, 6, 7], [1, 2, 3]]);
}

/// All orders of a small mesh's vertices, with every cache.
#[test]
fn no_order_of_vertices_takes_fewer_transforms() {
    let mesh = [[0, 1, 2], [2, 3, 4], [4, 5, 2], [1, 3, 2], [5, 4, 1]];
    let ours = renumber(&mesh, &vertices(&mesh, 6));
    let least: Vec<usize> = (0..=6).map(|cached| transforms(&ours, 6, cached)).collect();
    let mut orders = vec![vec![]];
    for _ in 0..6 {
        let longer = |order: &Vec<u16>| {
            let order = order.clone();
            (0..6)
                .filter(|v| !order.contains(v))
                .map(|v| [order.as_slice(), &[v]].concat())
                .collect::<Vec<_>>()
        };
        orders = orders.iter().flat_map(longer).collect();
    }
    assert_eq!(orders.len(), 720);
    let mut better_somewhere = 0;
    for order in orders {
        let other = renumber(&mesh, &order);
        for (cached, least) in least.iter().enumerate() {
            let transforms = transforms(&other, 6, cached);
            assert!(transforms >= *least, "{order:?} {cached}");
            better_somewhere += usize::from(transforms > *least);
        }
    }
    assert!(better_somewhere > 1000);
}
