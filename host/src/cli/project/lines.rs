//! [`own_lines`]: of a module's debug information, the lines of the project's own files.
//!
//! That is what a backtrace can show. The rest of what a compiler writes is larger than the code,
//! and has the folders of the machine that compiled it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use gimli::write;

/// The sections of debug information, by name.
pub type Sections<'a> = BTreeMap<&'a str, &'a [u8]>;

/// A part of the code section that comes from one place in a file of the project.
#[derive(Debug, PartialEq, Eq)]
struct Row {
    begin: u64,
    end: u64,
    /// Relative to the project, with `/` between its parts.
    file: String,
    line: u32,
    column: u32,
}

/// New sections, with their names, that say for addresses in a code section of `code_bytes` which
/// line of a file in `folder` they come from. Empty when no line is known.
///
/// Code that was inlined from elsewhere, such as the standard library, counts as the line that
/// called it.
pub fn own_lines(
    sections: &Sections<'_>,
    code_bytes: u64,
    folder: &Path,
) -> Result<Vec<(&'static str, Vec<u8>)>, gimli::Error> {
    let rows = rows(sections, code_bytes, &roots(folder))?;
    if rows.is_empty() {
        return Ok(Vec::new());
    }
    // Nothing that is written here can be out of range.
    Ok(written(&rows, code_bytes).unwrap_or_default())
}

/// The ways in which a compiler may have named the folder.
fn roots(folder: &Path) -> Vec<PathBuf> {
    [std::path::absolute(folder), folder.canonicalize()]
        .into_iter()
        .flatten()
        .collect()
}

fn rows(
    sections: &Sections<'_>,
    code_bytes: u64,
    roots: &[PathBuf],
) -> Result<Vec<Row>, gimli::Error> {
    let dwarf = gimli::Dwarf::load(|id| {
        let data = sections.get(id.name()).copied().unwrap_or_default();
        Ok::<_, gimli::Error>(gimli::EndianSlice::new(data, gimli::LittleEndian))
    })?;
    let context = addr2line::Context::from_dwarf(dwarf)?;
    let mut rows: Vec<Row> = Vec::new();
    // Linkers put what they left out at address 0, where the number of functions is.
    for (begin, size, _) in context.find_location_range(1, code_bytes)? {
        let mut frames = context.find_frames(begin).skip_all_loads()?;
        while let Some(frame) = frames.next()? {
            let Some(location) = frame.location else {
                continue;
            };
            let file = location.file.and_then(|file| within(roots, file));
            if let (Some(file), Some(line)) = (file, location.line) {
                rows.push(Row {
                    begin,
                    end: begin.saturating_add(size),
                    file,
                    line,
                    column: location.column.unwrap_or(0),
                });
                break;
            }
        }
    }
    rows.sort_by_key(|row| row.begin);
    rows.dedup_by(|next, row| {
        let continues = row.end == next.begin
            && (&row.file, row.line, row.column) == (&next.file, next.line, next.column);
        if continues {
            row.end = next.end;
        }
        continues || next.begin < row.end
    });
    Ok(rows)
}

/// The file relative to a root, if it is below one.
fn within(roots: &[PathBuf], file: &str) -> Option<String> {
    let relative = roots
        .iter()
        .find_map(|it| Path::new(file).strip_prefix(it).ok())?;
    let parts = relative.iter().map(|part| part.to_str());
    Some(parts.collect::<Option<Vec<_>>>()?.join("/"))
}

fn written(rows: &[Row], code_bytes: u64) -> write::Result<Vec<(&'static str, Vec<u8>)>> {
    let encoding = gimli::Encoding {
        address_size: 4,
        format: gimli::Format::Dwarf32,
        // Later versions want a folder that files are relative to.
        version: 4,
    };
    let mut dwarf = write::DwarfUnit::new(encoding);
    let name = |text: &str| write::LineString::String(text.as_bytes().to_vec());
    let mut program = write::LineProgram::new(
        encoding,
        gimli::LineEncoding::default(),
        name(""),
        None,
        name(""),
        None,
    );
    let folder = program.default_directory();
    let mut last_end = None;
    let mut sequence_begin = 0;
    for row in rows {
        if last_end != Some(row.begin) {
            if let Some(end) = last_end {
                program.end_sequence(end - sequence_begin);
            }
            sequence_begin = row.begin;
            program.begin_sequence(Some(write::Address::Constant(row.begin)));
        }
        let file = program.add_file(name(&row.file), folder, None);
        let next = program.row();
        next.address_offset = row.begin - sequence_begin;
        next.file = file;
        next.line = u64::from(row.line);
        next.column = u64::from(row.column);
        program.generate_row();
        last_end = Some(row.end);
    }
    if let Some(end) = last_end {
        program.end_sequence(end - sequence_begin);
    }
    dwarf.unit.line_program = program;
    let root = dwarf.unit.root();
    let unit = dwarf.unit.get_mut(root);
    unit.set(
        gimli::DW_AT_low_pc,
        write::AttributeValue::Address(write::Address::Constant(0)),
    );
    unit.set(
        gimli::DW_AT_high_pc,
        write::AttributeValue::Udata(code_bytes),
    );
    let mut sections = write::Sections::new(write::EndianVec::new(gimli::LittleEndian));
    dwarf.write(&mut sections)?;
    let mut all = Vec::new();
    sections.for_each(|id, data| {
        if !data.slice().is_empty() {
            all.push((id.name(), data.slice().to_vec()));
        }
        Ok::<_, write::Error>(())
    })?;
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(begin: u64, end: u64, file: &str, line: u32) -> Row {
        Row {
            begin,
            end,
            file: file.to_owned(),
            line,
            column: 5,
        }
    }

    /// What is read again of written rows whose files are in `/robot`.
    fn read(rows: &[Row], root: &str) -> Vec<Row> {
        let rows: Vec<Row> = rows
            .iter()
            .map(|it| row(it.begin, it.end, &format!("/robot/{}", it.file), it.line))
            .collect();
        let written = written(&rows, 100).unwrap();
        let sections = written.iter().map(|(name, data)| (*name, &data[..]));
        super::rows(&sections.collect(), 100, &[root.into()]).unwrap()
    }

    #[test]
    fn what_is_written_is_read_again() {
        let rows = [
            row(1, 7, "src/a.zig", 3),
            row(7, 9, "src/a.zig", 2),
            // A gap, and another file.
            row(20, 100, "b.zig", 1000),
        ];
        assert_eq!(read(&rows, "/robot"), rows);
        assert_eq!(
            read(&rows, "/robot/src"),
            [row(1, 7, "a.zig", 3), row(7, 9, "a.zig", 2)]
        );
        assert_eq!(read(&rows, "/rob"), []);
    }

    #[test]
    fn rows_of_one_line_are_one() {
        let rows = [row(2, 4, "a.zig", 3), row(4, 9, "a.zig", 3)];
        assert_eq!(read(&rows, "/robot"), [row(2, 9, "a.zig", 3)]);
    }

    #[test]
    fn damaged_information_has_no_lines() {
        let folder = Path::new("/robot");
        assert_eq!(own_lines(&Sections::new(), 100, folder), Ok(Vec::new()));
        let damaged = Sections::from([(".debug_info", &b"\x10\0\0\0\x04\0garbage"[..])]);
        assert!(own_lines(&damaged, 100, folder).map_or(true, |it| it.is_empty()));
    }
}
