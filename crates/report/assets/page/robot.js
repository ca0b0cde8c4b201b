"use strict";
// Robots on a canvas: their recorded points, frame by frame, as colored voxels on the ground.

const themed = name => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();

/** Points as hundredths of a voxel, from the base64 of 16-bit numbers, lower byte first. */
function decode(text) {
  const raw = atob(text), view = new DataView(new ArrayBuffer(raw.length));
  for (let i = 0; i < raw.length; i++) view.setUint8(i, raw.charCodeAt(i));
  return Int16Array.from({ length: raw.length / 2 }, (_, i) => view.getInt16(2 * i, true));
}

/** Makes a canvas fit its place, `height` pixels high; gives what to draw with, and its width. */
function fit(canvas, height) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth || 320;
  canvas.style.height = height + "px";
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return [pen, width];
}

/** A robot's points at a frame; between two frames they go straight. */
function poseAt(robot, frame) {
  robot.points ??= decode(robot.frames);
  const size = robot.corners * 2, last = robot.points.length / size - 1;
  const at = Math.max(0, Math.min(frame, last)), before = Math.floor(at), part = at - before;
  const after = Math.min(before + 1, last), pose = new Float64Array(size);
  for (let i = 0; i < size; i++) {
    pose[i] = (robot.points[before * size + i] * (1 - part) + robot.points[after * size + i] * part) / 100;
  }
  return pose;
}

/** The middle of a pose along the ground. */
function middle(pose) {
  let sum = 0;
  for (let i = 0; i < pose.length; i += 2) sum += pose[i];
  return pose.length ? 2 * sum / pose.length : 0;
}

/** Sky, and ground with a short tick for each voxel and a long one for each fifth, around the place `camera`. */
function drawGround(pen, { left, top, width, ground, scale, camera }) {
  pen.fillStyle = themed("sky");
  pen.fillRect(left, top, width, ground - top);
  pen.fillStyle = themed("ground");
  pen.fillRect(left, ground, width, 9);
  pen.fillStyle = "#fff9";
  const half = width / 2 / scale;
  for (let voxel = Math.ceil(camera - half); voxel <= camera + half; voxel++) {
    pen.fillRect(left + (voxel - camera + half) * scale, ground, 1, voxel % 5 ? 3 : 8);
  }
}

function drawPose(pen, robot, pose, { left, width, ground, scale, camera }, looks) {
  const x = place => left + width / 2 + (place - camera) * scale, y = height => ground - height * scale;
  pen.lineWidth = .8;
  pen.strokeStyle = themed("edge");
  for (const [a, b, c, d, place] of robot.voxels) {
    pen.beginPath();
    [a, b, c, d].forEach((n, i) => pen[i ? "lineTo" : "moveTo"](x(pose[2 * n]), y(pose[2 * n + 1])));
    pen.closePath();
    pen.fillStyle = looks[place].color;
    pen.fill();
    pen.stroke();
    if (looks[place].mark) drawMark(pen, looks[place], [a, b, c, d].map(n => [x(pose[2 * n]), y(pose[2 * n + 1])]));
  }
}

/** The sign of a material on its voxel, whose corners stand around it from the top left. */
function drawMark(pen, { ink, mark }, [a, b, c, d]) {
  const across = (from, to, share) => from + (to - from) * share;
  pen.fillStyle = ink;
  for (const polygon of mark) {
    pen.beginPath();
    polygon.forEach(([x, y], i) => pen[i ? "lineTo" : "moveTo"](
      ...[0, 1].map(axis => across(across(a[axis], b[axis], x), across(d[axis], c[axis], x), y))));
    pen.fill();
  }
}

/** A square for each stimulus, filled while it is present. */
function drawStimuli(pen, sensed, x, y) {
  sensed.forEach((present, i) => {
    pen.strokeStyle = pen.fillStyle = themed("s" + (i + 1));
    pen.lineWidth = 2;
    pen.strokeRect(x + i * 22, y, 14, 14);
    if (present) pen.fillRect(x + i * 22, y, 14, 14);
  });
}

/** A robot's name and what is known of it, put into `panel`. */
function describe(panel, title, facts) {
  const name = document.createElement("strong"), list = document.createElement("dl");
  name.textContent = title;
  for (const [key, value] of facts) {
    list.append(Object.assign(document.createElement("dt"), { textContent: key }));
    list.append(Object.assign(document.createElement("dd"), { textContent: value }));
  }
  panel.replaceChildren(name, list);
}
