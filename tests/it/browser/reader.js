const section = document.getElementById("swarm-0"), slider = section.querySelector(".scrub");
const stage = section.querySelector(".stage"), shot = () => stage.querySelector("canvas").toDataURL();
const cell = name => section.querySelector(`[data-id="cell-${name}"]`);
let still = "";
const drawn = () => (still = shot()).length > 5000, moved = () => shot() !== still && Number(slider.value) > 1;
later(drawn, () => { section.querySelector(".play").click(); later(moved, () => {
  const walked = moved(), tall = stage.clientHeight; section.querySelector(".play").click();
  cell(1).dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));
  const alone = stage.clientHeight, pressed = cell(1).getAttribute("aria-pressed");
  const panel = section.querySelector(".robot").textContent;
  cell(2).dispatchEvent(new MouseEvent("mouseover", { bubbles: true }));
  const hovered = section.querySelector(".robot").textContent;
  slider.value = 6; slider.dispatchEvent(new Event("input"));
  const clock = section.querySelector(".clock").textContent, wide = document.documentElement.scrollWidth <= innerWidth;
  tell({ walked, tall, alone, pressed, panel, hovered, focusable: cell(1).tabIndex, clock, wide });
}); });
