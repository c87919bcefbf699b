// SPDX-License-Identifier: Apache-2.0
// Where the camera goes: looks from named sides, and how far off something fits into the picture.
import { PerspectiveCamera, Vector3 } from 'three';

export type Side = 'top' | 'front' | 'side' | 'iso';

/** The direction in which one looks, z up. A plan looks down, but for a trifle that keeps north up. */
export const VIEW_DIRECTIONS: Record<Side, readonly [number, number, number]> = {
  top: [0, 0.0005, -1],
  front: [0, 1, 0],
  side: [-1, 0, 0],
  iso: [-1, 1, -0.8],
};

export function makeCamera(): PerspectiveCamera {
  const camera = new PerspectiveCamera(32, 1, 1, 1e6);
  camera.up.set(0, 0, 1);
  return camera;
}

/** How far from its middle a ball fits into the picture. */
export function distanceFor(camera: PerspectiveCamera, radius: number): number {
  const vertical = (camera.fov * Math.PI) / 360;
  const horizontal = Math.atan(Math.tan(vertical) * camera.aspect);
  return radius / Math.sin(Math.min(vertical, horizontal));
}

/** How far from its middle a box fits into the picture, a little air round it, seen as the camera looks. */
export function distanceForBox(camera: PerspectiveCamera, size: Vector3): number {
  const vertical = Math.tan((camera.fov * Math.PI) / 360) / 1.08;
  const horizontal = vertical * camera.aspect;
  const turn = camera.quaternion.clone().invert();
  let away = 0;
  for (let i = 0; i < 8; ++i) {
    const corner = new Vector3(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5).multiply(size).applyQuaternion(turn);
    away = Math.max(away, corner.z + Math.max(Math.abs(corner.x) / horizontal, Math.abs(corner.y) / vertical));
  }
  return away;
}

/** Sets the planes between which one sees, by what there is to be seen. */
export function setDepth(camera: PerspectiveCamera, target: Vector3, reach: number): void {
  const away = camera.position.distanceTo(target);
  camera.near = Math.max(away / 500, 0.5);
  camera.far = away + reach + 1;
  camera.updateProjectionMatrix();
}
