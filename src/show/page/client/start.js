// The elements of the page, and the message that replaces a view that cannot be drawn.

const element = (id) => document.getElementById(id);
const canvas = element('view');
const cover = element('cover');

/** Covers the view with a message; nothing uncovers it. */
function say(message) {
  cover.textContent = message;
  cover.hidden = false;
}

