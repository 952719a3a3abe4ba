"use strict";

/**
 * Triangles, three corners each, with a normal at each corner.
 * @typedef {{positions: number[], normals: number[]}} Mesh
 */

/** @param {Mesh} mesh @param {Vec3[]} corners @param {Vec3[]} normals */
function addTriangle(mesh, corners, normals) {
  for (const corner of corners) mesh.positions.push(...corner);
  for (const normal of normals) mesh.normals.push(...normal);
}

/** @param {Mesh} mesh @param {Vec3[]} corners of a quadrangle, in a ring @param {Vec3[]} normals */
function addQuad(mesh, [a, b, c, d], [na, nb, nc, nd]) {
  addTriangle(mesh, [a, b, c], [na, nb, nc]);
  addTriangle(mesh, [a, c, d], [na, nc, nd]);
}

/** @param {Vec3} center @param {number} radius @param {number} steps from pole to pole @returns {Mesh} */
function sphereMesh(center, radius, steps) {
  const mesh = { positions: [], normals: [] };
  const normal = (i, j) => {
    const down = (Math.PI * i) / steps;
    const round = (Math.PI * j) / steps;
    return [Math.sin(down) * Math.cos(round), Math.cos(down), Math.sin(down) * Math.sin(round)];
  };
  for (let i = 0; i < steps; ++i) {
    for (let j = 0; j < 2 * steps; ++j) {
      const normals = [normal(i, j), normal(i, j + 1), normal(i + 1, j + 1), normal(i + 1, j)];
      addQuad(
        mesh,
        normals.map((n) => addScaled3(center, n, radius)),
        normals,
      );
    }
  }
  return mesh;
}

/** @param {Vec3[]} corners @returns {Mesh} */
function triangleMesh(corners) {
  const normal = unit3(cross3(sub3(corners[1], corners[0]), sub3(corners[2], corners[0])));
  const mesh = { positions: [], normals: [] };
  addTriangle(mesh, corners, [normal, normal, normal]);
  return mesh;
}

/** The mantle between two rings. @param {Vec3[]} ends @param {number[]} radii @param {number} steps @returns {Mesh} */
function coneMesh(ends, radii, steps) {
  const axis = sub3(ends[1], ends[0]);
  const side = across3(axis);
  const other = unit3(cross3(axis, side));
  const outward = (k) => {
    const angle = (2 * Math.PI * k) / steps;
    return addScaled3([0, 0, 0], side, Math.cos(angle)).map((part, i) => part + Math.sin(angle) * other[i]);
  };
  const mesh = { positions: [], normals: [] };
  for (let k = 0; k < steps; ++k) {
    const [n, m] = [outward(k), outward(k + 1)];
    const ring = [
      [0, n],
      [0, m],
      [1, m],
      [1, n],
    ].map(([end, out]) => addScaled3(ends[end], out, radii[end]));
    addQuad(mesh, ring, [n, m, m, n]);
  }
  return mesh;
}

/**
 * @param {{kind: string, points: Vec3[], radii: number[]}} surface as `raysteps/inspect/v1` tells it
 * @returns {Mesh | null} nothing for a kind that is not known
 */
function meshOf(surface) {
  if (surface.radii.length === 1) return sphereMesh(surface.points[0], Math.abs(surface.radii[0]), 20);
  if (surface.radii.length === 2) return coneMesh(surface.points, surface.radii, 24);
  return surface.points.length === 3 ? triangleMesh(surface.points) : null;
}

/** The twelve edges. @param {Vec3} min @param {Vec3} max @returns {[Vec3, Vec3][]} */
function boxEdges(min, max) {
  const corner = (bits) => [0, 1, 2].map((axis) => ((bits >> axis) & 1 ? max : min)[axis]);
  const edges = [];
  for (let from = 0; from < 8; ++from) {
    for (let axis = 0; axis < 3; ++axis) {
      if (!((from >> axis) & 1)) edges.push([corner(from), corner(from | (1 << axis))]);
    }
  }
  return edges;
}
