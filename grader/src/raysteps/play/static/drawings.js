// What the live figures draw, step by step. Each asks framework/web/figures.cpp: whatever is a step's work comes from
// there, by the student's functions. Only what a reader sets, or what is given, is known here: these files go out to
// students, so no formula of a step stands in them. `onlyNumbers` are functions that a drawing does without: where they
// are stubs, it is there all the same, and the numbers wait.

import { CAMERA } from "./drawing-camera.js";
import { GLASS } from "./drawing-glass.js";
import { LAMP, LENS } from "./drawing-lamp.js";
import { PHONG, SHADOW } from "./drawing-light.js";
import { LEVEL, MESH } from "./drawing-mesh.js";
import { FRESNEL, METAL } from "./drawing-metal.js";
import { MIRRORS } from "./drawing-mirrors.js";
import { COSINE, ROULETTE } from "./drawing-paths.js";
import { SPHERE, TRIANGLE } from "./drawing-rays.js";
import { FILTER, SAMPLES } from "./drawing-samples.js";
import { TONE } from "./drawing-tone.js";
import { CUTS, OCTREE } from "./drawing-trees.js";
import { WAYS, WEIGHTS } from "./drawing-weights.js";

const OF_STEPS = {
  "01": [CAMERA],
  "02": [SPHERE, TRIANGLE],
  "03": [PHONG],
  "04": [SHADOW],
  "05": [MIRRORS],
  "06": [OCTREE],
  "07": [TONE],
  "08": [GLASS],
  "09": [CUTS],
  10: [SAMPLES, FILTER],
  11: [MESH, LEVEL],
  12: [LAMP, LENS],
  13: [COSINE, ROULETTE],
  14: [FRESNEL, METAL],
  15: [WEIGHTS, WAYS],
};

export const drawingsOf = (number) => OF_STEPS[number] ?? [];
