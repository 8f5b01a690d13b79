//! Pictures of the page, to be looked at.

use std::path::Path;

use crate::browser::Browser;
use crate::check::tables::drop_file;
use crate::check::{READY, choose};

/// Name, width and height of the window, and colour scheme.
const PICTURES: [(&str, (u32, u32), &str); 4] = [
    ("phone-light", (390, 740), "light"),
    ("phone-dark", (360, 740), "dark"),
    ("desktop-light", (1280, 900), "light"),
    ("desktop-dark", (1280, 900), "dark"),
];

/// Writes pictures of the page at the width of a phone and of a desktop, and checks that nothing is wider than the window.
pub fn write(browser: &mut Browser, file: &Path, table: &[u8]) -> Result<(), String> {
    for (name, size, scheme) in PICTURES {
        browser.open(file, size, scheme)?;
        browser.wait_for(READY)?;
        drop_file(browser, "cases.csv", table)?;
        browser.value("document.querySelector('#mapping button').click()")?;
        browser.wait_for("!!document.getElementById('download')")?;
        let width = browser.value("document.documentElement.scrollWidth")?;
        if width != size.0 {
            return Err(format!("{name}: the page is {width} pixels wide in a window of {}", size.0));
        }
        browser.value("window.scrollTo(0, 0)")?;
        browser.screenshot(&file.with_file_name(format!("{name}.png")), false)?;
        browser.screenshot(&file.with_file_name(format!("{name}-whole.png")), true)?;

        choose(browser, "law", "hertz")?;
        choose(browser, "compliance", "elastic")?;
        browser.value("for (const fold of document.querySelectorAll('#scene details')) fold.open = true")?;
        drop_file(browser, "own.csv", b"half width;solid;k;speed\n2,5;2600;75;2,8\n")?;
        choose(browser, "column-radius_m", "half width")?;
        browser.wait_for(READY)?;
        browser.screenshot(&file.with_file_name(format!("{name}-other.png")), true)?;
    }
    Ok(())
}
