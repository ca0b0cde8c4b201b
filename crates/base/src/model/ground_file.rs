//! Ground of the world files of Evolution Gym's design tool: JSON with objects, each of voxels in numbered cells.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::GroundProfile;
use super::wording::GroundFileError;

const FIXED: f64 = 5.0;

#[derive(Deserialize)]
struct WorldFile {
    grid_width: usize,
    objects: BTreeMap<String, FileObject>,
}

/// The cells of its voxels, row by row from the bottom of the world, and their codes, perhaps with a decimal point.
#[derive(Deserialize)]
struct FileObject {
    indices: Vec<f64>,
    types: Vec<f64>,
}

impl GroundProfile {
    pub fn of_file(text: &str) -> Result<Self, GroundFileError> {
        let file: WorldFile =
            serde_json::from_str(text).map_err(|error| GroundFileError::NotWorld { reason: error.to_string() })?;
        let (most_columns, most_rows) = (Self::MOST_COLUMNS, Self::MOST_ROWS);
        let mut columns = Vec::new();
        for (object, FileObject { indices, types }) in &file.objects {
            if indices.len() != types.len() {
                let (object, cells, codes) = (object.clone(), indices.len(), types.len());
                return Err(GroundFileError::Uneven { object, cells, codes });
            }
            if types.iter().any(|code| *code != FIXED) {
                return Err(GroundFileError::NotFixed { object: object.clone() });
            }
            for &cell in indices {
                let is_whole = cell >= 0.0 && cell.fract() == 0.0 && cell < f64::from(u32::MAX);
                if !is_whole || file.grid_width == 0 {
                    return Err(GroundFileError::Cell { object: object.clone(), cell: cell.to_string() });
                }
                let (column, row) = (cell as usize % file.grid_width, cell as usize / file.grid_width);
                if column >= most_columns || row >= most_rows {
                    return Err(GroundFileError::TooLarge { column, row, most_columns, most_rows });
                }
                columns.resize(columns.len().max(column + 1), 0);
                columns[column] |= 1 << row;
            }
        }
        Self::of_cells(&columns).ok_or(GroundFileError::Empty)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(cells: &str, codes: &str) -> Result<GroundProfile, GroundFileError> {
        let object = format!(r#"{{"indices": [{cells}], "types": [{codes}], "neighbors": {{}}}}"#);
        GroundProfile::of_file(&format!(r#"{{"grid_width": 2, "grid_height": 3, "objects": {{"floor": {object}}}}}"#))
    }

    #[test]
    fn cells_are_numbered_from_the_bottom() {
        assert_eq!(file("0, 1, 5", "5, 5.0, 5").unwrap().columns(), [0b001, 0b101]);
        assert_eq!(file("2.0", "5").unwrap().columns(), [0b010]);
        assert!(file("0, 1", "5, 5").unwrap().is_flat());
    }

    #[test]
    fn other_files_are_refused() {
        let object = || "floor".to_owned();
        assert_eq!(file("0, 1", "5, 2"), Err(GroundFileError::NotFixed { object: object() }));
        assert_eq!(file("0, 1", "5"), Err(GroundFileError::Uneven { object: object(), cells: 2, codes: 1 }));
        assert_eq!(file("0.5", "5"), Err(GroundFileError::Cell { object: object(), cell: "0.5".to_owned() }));
        assert_eq!(file("-1", "5"), Err(GroundFileError::Cell { object: object(), cell: "-1".to_owned() }));
        let (most_columns, most_rows) = (GroundProfile::MOST_COLUMNS, GroundProfile::MOST_ROWS);
        let large = GroundFileError::TooLarge { column: 1, row: 32, most_columns, most_rows };
        assert_eq!(file("65", "5"), Err(large));
        assert_eq!(file("", ""), Err(GroundFileError::Empty));
        for text in ["", "{", "[]", r#"{"grid_width": 2}"#, r#"{"grid_width": -2, "objects": {}}"#] {
            assert!(matches!(GroundProfile::of_file(text), Err(GroundFileError::NotWorld { .. })), "{text}");
        }
    }
}
