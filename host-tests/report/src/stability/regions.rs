//! Connected regions of a map.

/// Cells that touch each other, if only by a corner.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Region {
    /// First and last.
    pub(super) columns: (usize, usize),
    pub(super) rows: (usize, usize),
    /// Row and column of each.
    pub(super) cells: Vec<(usize, usize)>,
}

/// The regions in which `marked` is true, of rows of equal length.
pub(super) fn regions(marked: &[Vec<bool>]) -> Vec<Region> {
    let mut left = marked.to_vec();
    let mut all = Vec::new();
    for row in 0..left.len() {
        for column in 0..left[row].len() {
            if left[row][column] {
                all.push(Region::from(&mut left, (row, column)));
            }
        }
    }
    all
}

impl Region {
    /// Takes the cells of the region out of those left.
    fn from(left: &mut [Vec<bool>], first: (usize, usize)) -> Self {
        left[first.0][first.1] = false;
        let mut region = Self { columns: (first.1, first.1), rows: (first.0, first.0), cells: vec![first] };
        let mut next = 0;
        while let Some(&(row, column)) = region.cells.get(next) {
            next += 1;
            region.rows = (region.rows.0.min(row), region.rows.1.max(row));
            region.columns = (region.columns.0.min(column), region.columns.1.max(column));
            for near in row.saturating_sub(1)..(row + 2).min(left.len()) {
                for beside in column.saturating_sub(1)..(column + 2).min(left[near].len()) {
                    if std::mem::take(&mut left[near][beside]) {
                        region.cells.push((near, beside));
                    }
                }
            }
        }
        region
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(rows: &[&str]) -> Vec<((usize, usize), (usize, usize), usize)> {
        let marked: Vec<Vec<bool>> = rows.iter().map(|row| row.chars().map(|cell| cell == '#').collect()).collect();
        regions(&marked).iter().map(|region| (region.rows, region.columns, region.cells.len())).collect()
    }

    #[test]
    fn none_in_an_empty_map() {
        assert_eq!(found(&[]), []);
        assert_eq!(found(&["...", "..."]), []);
    }

    #[test]
    fn corners_join_and_gaps_part() {
        assert_eq!(found(&["#..#", ".#..", "#..#"]), [((0, 2), (0, 1), 3), ((0, 0), (3, 3), 1), ((2, 2), (3, 3), 1)]);
        assert_eq!(found(&["####", "#..#", "####"]), [((0, 2), (0, 3), 10)]);
    }
}
