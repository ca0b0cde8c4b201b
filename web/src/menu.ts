// Menus that open below their name.

/** Closes a menu when something outside of it is pressed, or with Escape. */
export function closeOutside(menu: HTMLDetailsElement): void {
  document.addEventListener("pointerdown", event => {
    if (menu.open && !menu.contains(event.target as Node)) {
      menu.open = false;
    }
  });
  menu.addEventListener("keydown", event => {
    if (event.key === "Escape") {
      menu.open = false;
      menu.querySelector("summary")?.focus();
    }
  });
}
