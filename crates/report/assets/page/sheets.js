"use strict";
// A page with a schematic alone.

const data = JSON.parse(document.getElementById("data").textContent);
window.schematic = new Schematic(document.querySelector(".schematic"), data.schematic, data.cells);
