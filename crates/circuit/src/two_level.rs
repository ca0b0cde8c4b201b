//! Two-level logic: few cubes for a truth table with open entries.

/// Cubes whose sum is 1 wherever `on` is and nowhere that `may` is not. Each cube has a digit `0`, `1` or `-` for each
/// input, and none is redundant. The tables have an entry for each row in counting order; the first input is the
/// highest bit. By the recursion of Minato and Morreale.
pub fn cover(on: &[bool], may: &[bool]) -> Vec<Vec<u8>> {
    assert!(on.len() == may.len() && on.len().is_power_of_two(), "tables of all rows");
    let mut cubes = Vec::new();
    let mut cube = Vec::new();
    part(on, may, &mut cube, &mut cubes);
    let width = on.len().ilog2() as usize;
    cubes.iter_mut().for_each(|cube| cube.resize(width, b'-'));
    cubes
}

fn part(on: &[bool], may: &[bool], cube: &mut Vec<u8>, cubes: &mut Vec<Vec<u8>>) -> Vec<bool> {
    if !on.contains(&true) {
        return vec![false; on.len()];
    }
    if !may.contains(&false) {
        cubes.push(cube.clone());
        return vec![true; on.len()];
    }
    let half = on.len() / 2;
    let ((on_0, on_1), (may_0, may_1)) = (on.split_at(half), may.split_at(half));
    let mut side = |digit: u8, on: &[bool], may: &[bool], other: &[bool]| {
        let alone: Vec<bool> = on.iter().zip(other).map(|(&on, &other)| on && !other).collect();
        cube.push(digit);
        let covered = part(&alone, may, cube, cubes);
        cube.pop();
        covered
    };
    let covered_0 = side(b'0', on_0, may_0, may_1);
    let covered_1 = side(b'1', on_1, may_1, may_0);
    let rest: Vec<bool> = (0..half).map(|row| on_0[row] && !covered_0[row] || on_1[row] && !covered_1[row]).collect();
    let both: Vec<bool> = may_0.iter().zip(may_1).map(|(&zero, &one)| zero && one).collect();
    cube.push(b'-');
    let shared = part(&rest, &both, cube, cubes);
    cube.pop();
    let joined = |covered: Vec<bool>| covered.into_iter().zip(&shared).map(|(own, &shared)| own || shared);
    joined(covered_0).chain(joined(covered_1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(on: &str, may: &str, expected: &[&str]) {
        let table = |digits: &str| digits.bytes().map(|digit| digit == b'1').collect::<Vec<_>>();
        let cubes = cover(&table(on), &table(may));
        let cubes: Vec<&str> = cubes.iter().map(|cube| str::from_utf8(cube).unwrap()).collect();
        assert_eq!(cubes, expected);
    }

    #[test]
    fn open_rows_make_cubes_larger() {
        check("0001", "0001", &["11"]);
        check("0110", "0110", &["01", "10"]);
        check("0111", "0111", &["1-", "-1"]);
        check("0001", "0011", &["1-"]);
        check("0000", "1111", &[]);
        check("1000", "1111", &["--"]);
        check("1", "1", &[""]);
    }

    #[test]
    fn every_table_of_four_inputs_is_covered_exactly() {
        for bits in 0..1u32 << 16 {
            let on: Vec<bool> = (0..16).map(|row| bits >> row & 1 == 1).collect();
            let cubes = cover(&on, &on);
            for (row, &on) in on.iter().enumerate() {
                let matches = |cube: &Vec<u8>| {
                    cube.iter()
                        .enumerate()
                        .all(|(at, &digit)| digit == b'-' || (digit == b'1') == (row >> (3 - at) & 1 == 1))
                };
                assert_eq!(cubes.iter().any(matches), on, "{bits:016b} row {row}");
            }
        }
    }
}
