// The elements of the page, and what is said when it cannot be shown.

const element = (id) => document.getElementById(id);
const canvas = element('view');
const cover = element('cover');

/** Covers the view with a message; nothing uncovers it. */
function say(message) {
  cover.textContent = message;
  cover.hidden = false;
}

