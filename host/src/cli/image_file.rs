//! Files that pictures are written to: the format that a name asks for, and the pixels.

use std::path::Path;

use super::failure::Failure;
use super::output::{self, Existing, message};
use crate::report::raster::{draw, png};
use crate::report::text::{Text, text};

/// A format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Svg,
    Png,
    Gif,
    Apng,
}

impl Format {
    /// With its extension.
    const ALL: [(Self, &'static str); 4] = [
        (Self::Svg, "svg"),
        (Self::Png, "png"),
        (Self::Gif, "gif"),
        (Self::Apng, "apng"),
    ];

    /// The format that the extension of a file asks for.
    ///
    /// # Errors
    ///
    /// When it is none of these.
    pub fn of(path: &Path, formats: &[Self]) -> Result<Self, Failure> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let known = Self::ALL.into_iter().find(|it| extension == it.1);
        if let Some((format, _)) = known.filter(|it| formats.contains(&it.0)) {
            return Ok(format);
        }
        let names = Self::ALL.into_iter().filter(|it| formats.contains(&it.0));
        let names: Vec<String> = names.map(|it| format!(".{}", it.1)).collect();
        let what = match (extension.is_empty(), known) {
            (true, _) => text!("`{}` has no extension", Text::of_path(path)),
            (false, Some(_)) => text!(
                "`{}`: this command does not write that format",
                Text::of_path(path)
            ),
            (false, None) => text!("`{}`: unknown picture format", Text::of_path(path)),
        };
        let (last, others) = names.split_last().expect("some format is possible");
        let listed = match others {
            [] => last.clone(),
            _ => format!("{} or {last}", others.join(", ")),
        };
        Err(Failure::usage(what).hint(format!("use a name that ends in {listed}")))
    }
}

/// Writes a document as it is, or its pixels; `width` is that of a PNG file.
///
/// # Errors
///
/// When the image would be too large or the file cannot be written.
pub fn save(
    svg: &str,
    (path, format): (&Path, Format),
    width: u32,
    existing: Existing,
) -> Result<(), Failure> {
    let bytes = match format {
        Format::Png => png(&draw(svg, width).map_err(Failure::usage)?),
        _ => svg.as_bytes().to_vec(),
    };
    output::save(path, &bytes, existing)?;
    message!("wrote {}", Text::of_path(path));
    Ok(())
}
