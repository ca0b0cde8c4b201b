const section = document.getElementById("swarm-1"), slider = section.querySelector(".scrub");
const shot = () => section.querySelector(".stage canvas").toDataURL();
let still = "";
const drawn = () => (still = shot()).length > 5000, moved = () => shot() !== still && Number(slider.value) > 1;
section.scrollIntoView();
const rows = [...section.querySelectorAll("tr")].filter(row => row.querySelector("td"))
  .map(row => [...row.cells].map(cell => cell.textContent.trim()));
later(drawn, () => {
  section.querySelector(".play").click();
  later(moved, () => tell({ walked: moved(), rows, wide: document.documentElement.scrollWidth <= innerWidth }));
});
