const niches = [...document.querySelectorAll("button.niche")], last = niches[niches.length - 1];
const stage = document.querySelector(".stage"), slider = document.querySelector(".scrub");
const { elites } = JSON.parse(document.getElementById("data").textContent);
last.click();
const elite = elites[Number(last.dataset.elite)], shot = () => stage.toDataURL();
let still = "";
const drawn = () => (still = shot()).length > 2000, moved = () => shot() !== still && Number(slider.value) > 0.2;
later(drawn, () => later(moved, () => {
  const walked = moved(), panel = document.querySelector(".robot").textContent;
  niches[0].focus(); niches[0].dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
  const stepped = document.activeElement === niches[1], maps = document.querySelectorAll(".map").length;
  const axis = document.querySelectorAll(".axis")[1]; axis.value = "2"; axis.dispatchEvent(new Event("change"));
  const again = document.querySelectorAll("button.niche").length;
  const wide = document.documentElement.scrollWidth <= innerWidth, body = elite.about[4][1];
  tell({ walked, behavior: elite.behavior, body, panel, stepped, maps, niches: niches.length, again, wide });
}));
