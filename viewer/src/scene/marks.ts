// SPDX-License-Identifier: Apache-2.0
// What is drawn over the model: the arrow of the depth, the section box, points that are measured.
import {
  BufferGeometry, ConeGeometry, Line, LineBasicMaterial, type Material, Mesh, MeshBasicMaterial, type Object3D, type PerspectiveCamera, Quaternion, Scene,
  SphereGeometry, Vector3,
} from 'three';
import type { Vec } from './items.ts';

const UP = new Vector3(0, 1, 0);

export class Marks {
  readonly scene = new Scene();
  private readonly ball = new SphereGeometry(1, 16, 12);
  private readonly cone = new ConeGeometry(0.5, 1.6, 16);
  // Made once for each colour: a new material costs more than drawing with it.
  private readonly faces = new Map<number, MeshBasicMaterial>();
  private readonly strokes = new Map<number, LineBasicMaterial>();

  constructor() {
    this.scene.matrixWorldAutoUpdate = false;
  }

  clear(): void {
    for (const child of this.scene.children) if (child instanceof Line) child.geometry.dispose();
    this.scene.clear();
  }

  line(points: Vec[], colour: number): void {
    this.add(new Line(new BufferGeometry().setFromPoints(points.map((p) => new Vector3(...p))), materialOf(this.strokes, colour, () => new LineBasicMaterial({ color: colour }))));
  }

  dot(at: Vec, colour: number): void {
    const ball = new Mesh(this.ball, this.face(colour));
    ball.position.set(...at);
    ball.userData.pixels = 5;
    this.add(ball);
  }

  /** The head of an arrow. */
  head(from: Vec, to: Vec, colour: number): void {
    const cone = new Mesh(this.cone, this.face(colour));
    cone.position.set(...to);
    cone.quaternion.copy(new Quaternion().setFromUnitVectors(UP, new Vector3(...to).sub(new Vector3(...from)).normalize()));
    cone.userData.pixels = 9;
    this.add(cone);
  }

  /** The edges of a box. */
  box(min: Vec, max: Vec, colour: number): void {
    const corner = (i: number): Vec => min.map((v, k) => ((i >> k) & 1 ? max[k]! : v)) as Vec;
    for (const path of [[0, 1, 3, 2, 0, 4, 5, 7, 6, 4], [1, 5], [3, 7], [2, 6]]) this.line(path.map(corner), colour);
  }

  /** Marks are as large on the screen from near as from afar. */
  size(camera: PerspectiveCamera, height: number): void {
    const perPixel = (2 * Math.tan((camera.fov * Math.PI) / 360)) / Math.max(1, height);
    for (const child of this.scene.children) {
      const pixels = child.userData.pixels as number | undefined;
      if (pixels) child.scale.setScalar(Math.max(1e-3, camera.position.distanceTo(child.position) * perPixel * pixels));
      child.updateMatrixWorld();
    }
  }

  private face(colour: number): MeshBasicMaterial {
    return materialOf(this.faces, colour, () => new MeshBasicMaterial({ color: colour }));
  }

  private add(object: Object3D): void {
    object.frustumCulled = false;
    this.scene.add(object);
  }
}

function materialOf<M extends Material>(made: Map<number, M>, colour: number, make: () => M): M {
  let material = made.get(colour);
  if (!material) {
    material = make();
    material.depthTest = false;
    material.transparent = true;
    made.set(colour, material);
  }
  return material;
}
