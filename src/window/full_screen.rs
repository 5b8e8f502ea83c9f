//! A window of X11 -> the same window over the whole screen, and back.
//!
//! minifb cannot do this. Rule: the window manager is asked as the Extended Window Manager Hints 1.5 say, "_NET_WM_STATE";
//! one that cannot is an error, and nothing changes.

use anyhow::ensure;
use x11rb::connection::Connection;
use x11rb::errors::ReplyError;
use x11rb::protocol::xproto::{AtomEnum, ClientMessageEvent, ConnectionExt, EventMask};

/// `_NET_WM_STATE_TOGGLE`.
const TOGGLE: u32 = 2;
/// The request comes from a program and not from a pager.
const FROM_PROGRAM: u32 = 1;
/// More properties than a window manager has.
const MAX_PROPERTIES: u32 = 1024;

/// Lets `window` cover the screen, or gives it its size again.
///
/// # Errors
/// When the X server does not answer, or its window manager has no such state.
pub fn toggle(window: u32) -> anyhow::Result<()> {
    let (connection, screen) = x11rb::connect(None)?;
    let root = connection.setup().roots[screen].root;
    let atom = |name: &[u8]| -> Result<u32, ReplyError> {
        Ok(connection.intern_atom(false, name)?.reply()?.atom)
    };
    let state = atom(b"_NET_WM_STATE")?;
    let full_screen = atom(b"_NET_WM_STATE_FULLSCREEN")?;
    let supported = atom(b"_NET_SUPPORTED")?;
    let supported = connection
        .get_property(false, root, supported, AtomEnum::ATOM, 0, MAX_PROPERTIES)?
        .reply()?;
    let mut supported = supported.value32().into_iter().flatten();
    let is_supported = supported.any(|it| it == full_screen);
    ensure!(is_supported, "the window manager offers none");
    let data = [TOGGLE, full_screen, 0, FROM_PROGRAM, 0];
    let message = ClientMessageEvent::new(32, window, state, data);
    let receivers = EventMask::SUBSTRUCTURE_REDIRECT | EventMask::SUBSTRUCTURE_NOTIFY;
    let sent = connection.send_event(false, root, receivers, message)?;
    // What the server has not read when the connection ends may be lost.
    sent.check()?;
    Ok(())
}
