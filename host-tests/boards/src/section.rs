//! The section of a page that a command writes.

use std::fs;
use std::path::{Path, PathBuf};

const END: &str = "<!-- end -->";

/// A section, between a line that names its command and one that ends it.
pub struct Section {
    path: PathBuf,
    /// The page up to the section, with the line that begins it.
    before: String,
    /// The text of the section.
    pub text: String,
    /// The page from the line that ends the section on.
    after: String,
}

impl Section {
    /// The section of a page that a command writes.
    pub fn read(path: &Path, command: &str) -> Result<Self, String> {
        let page = fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let begin = format!("<!-- written by {command} -->");
        let (before, rest) =
            page.split_once(&begin).ok_or_else(|| format!("{} lacks the line {begin}", path.display()))?;
        let (text, after) =
            rest.split_once(END).ok_or_else(|| format!("{} lacks {END} after {begin}", path.display()))?;
        Ok(Self {
            path: path.to_owned(),
            before: format!("{before}{begin}"),
            text: text.trim().to_owned(),
            after: format!("{END}{after}"),
        })
    }

    /// Writes the page with another text in the section.
    pub fn overwrite(&self, text: &str) -> Result<(), String> {
        let Self { path, before, after, .. } = self;
        let page = format!("{before}\n\n{}\n\n{after}", text.trim());
        fs::write(path, page).map_err(|error| format!("cannot write {}: {error}", path.display()))
    }
}
