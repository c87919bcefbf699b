// SPDX-License-Identifier: Apache-2.0
// The 3D view. A picture is drawn when something changes, and in pieces: the two objects of the clash and what is near
// first, within a frame, and then the rest as long as nothing moves. So it answers at once however large the model is.
import {
  Box3, BufferAttribute, BufferGeometry, Color, ColorManagement, Frustum, LineSegments, Matrix4, Mesh, type Object3D, type PerspectiveCamera,
  Scene, type ShaderMaterial, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { SceneHead } from '../payload/head.ts';
import type { Model } from '../payload/payload.ts';
import { type Batch, distanceTo, makeBatches } from './batches.ts';
import { distanceFor, distanceForBox, VIEW_DIRECTIONS, makeCamera, setDepth, type Side } from './camera.ts';
import { type BatchMaterials, GpuBatches } from './gpu_batches.ts';
import { sharpEdges } from './edges.ts';
import { type Items, isLine, itemsOf, linePieces, makeItems, meshOf, objectBox, type Vec } from './items.ts';
import { Marks } from './marks.ts';
import { makeMaterial, NOTHING, ObjectColours, type SharedUniforms } from './materials.ts';
import { type Hit, type Limits, pick, type Ray } from './ray.ts';

export type Others = 'ghost' | 'solid' | 'hide';

/** How an object of the clash is drawn: itself, its edges, and what of it something hides. */
interface Paint {
  body: ShaderMaterial;
  rim: ShaderMaterial;
  behind: ShaderMaterial;
  line: ShaderMaterial;
  lineBehind: ShaderMaterial;
}

/** A clash, in millimetres of the model. */
export interface Shown {
  a: number;
  b: number;
  at: Vec;
  /** what is drawn as the depth or the distance */
  arrow: { from: Vec; to: Vec; depth: boolean } | undefined;
}

/** Okabe and Ito's orange and blue: told apart with any kind of colour vision. */
export const COLOUR_A = 0xe69f00;
export const COLOUR_B = 0x2f8fd8;
const COLOUR_PICKED = 0x009e73;
const COLOUR_MARK = 0xd62f6b;
const COLOUR_SECTION = 0x8a63d2;

const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i;
const FAR = 1e12;
// How long the rest of a picture waits in software.
const BREATH_MS = 120;
// Of finer objects the outline takes longer than a click may, and shows less.
const MAX_OUTLINED = 60000;
// A line is thinner than a finger.
const PIXELS_BESIDE = 5;

export interface ViewEvents {
  picked(object: number | undefined): void;
  measured(points: Vec[]): void;
  drawn(): void;
  /** the graphics card gave up, or is there again */
  lost(lost: boolean): void;
}

export class View {
  readonly items: Items;
  readonly renderer: WebGLRenderer;
  readonly camera: PerspectiveCamera = makeCamera();
  readonly software: boolean;
  private readonly controls: OrbitControls;
  private readonly shared: SharedUniforms;
  private readonly ghosts: BatchMaterials;
  private readonly solids: BatchMaterials;
  private readonly batches: Batch[];
  private readonly gpu: GpuBatches;
  private readonly pieces = new Scene();
  private readonly pair = new Scene();
  private readonly hiddenPair = new Scene();
  private readonly marks = new Marks();
  private readonly origin: Vec;
  private readonly reach: number;
  private readonly paints = new Map<number, Paint>();
  private queue: Batch[] = [];
  private dirty = false;
  private visible = false;
  private width = 1;
  private height = 1;
  private scheduled = false;
  private pause: ReturnType<typeof setTimeout> | undefined;
  private fence: WebGLSync | undefined;
  private moving = false;
  /** triangles of the others in the first piece of a picture, while it is turned, and in each that follows */
  private readonly budgets: { first: number; moving: number; next: number };
  private fresh = false;
  private highlighted: number[] = [];
  private focus: Vec | undefined;
  private points: Vec[] = [];
  private ink = 0x111111;
  private others_: Others = 'ghost';
  measuring = false;
  shown: Shown | undefined;
  private sectionHalf: number | undefined;

  /** Throws where the browser has no WebGL 2. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    model: Model,
    head: SceneHead,
    objects: number,
    private readonly events: ViewEvents,
  ) {
    ColorManagement.enabled = false;
    const probe = document.createElement('canvas').getContext('webgl2');
    if (!probe) throw new Error('no WebGL 2');
    const info = probe.getExtension('WEBGL_debug_renderer_info');
    const name = String(probe.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : probe.RENDERER));
    probe.getExtension('WEBGL_lose_context')?.loseContext();
    this.software = SOFTWARE.test(name);
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.software, preserveDrawingBuffer: true, powerPreference: 'high-performance' });
    this.renderer.setPixelRatio(this.software ? 1 : Math.min(window.devicePixelRatio, 2));
    this.renderer.autoClear = false;
    // Asking whether a program was compiled waits until it is; the tests read pixels instead.
    this.renderer.debug.checkShaderErrors = false;
    this.budgets = this.software ? { first: 0, moving: 6000, next: 30000 } : { first: 1000000, moving: 1000000, next: 1500000 };
    this.origin = head.origin_mm;
    this.items = makeItems(model, head, objects);
    this.batches = makeBatches(this.items);
    this.gpu = new GpuBatches(this.items);
    const colours = new ObjectColours(objects);
    for (let o = 0; o < objects; ++o) colours.set(o, 0x9aa3ad);
    const { colour, object } = model.instances;
    if (colour) for (let i = 0; i < colour.length; ++i) colours.set(object[i]!, colour[i]!);
    this.shared = {
      states: { value: colours.texture }, apart: { value: new Vector2(NOTHING, NOTHING) }, sectionMin: { value: new Vector3(-FAR, -FAR, -FAR) },
      sectionMax: { value: new Vector3(FAR, FAR, FAR) }, focus: { value: new Vector3() }, fade: { value: FAR },
    };
    const both = (ghost: boolean): BatchMaterials => ({
      instanced: makeMaterial(this.shared, { instanced: true, ghost }),
      merged: makeMaterial(this.shared, { ghost }),
      lines: makeMaterial(this.shared, { ghost, lines: true }),
    });
    this.ghosts = both(true);
    this.solids = both(false);
    for (const scene of [this.pieces, this.pair, this.hiddenPair]) scene.matrixWorldAutoUpdate = false;
    const { bounds } = this.items;
    this.reach = Math.max(1000, 2 * Math.hypot(bounds[3]! - bounds[0]!, bounds[4]! - bounds[1]!, bounds[5]! - bounds[2]!));
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('start', () => (this.moving = true));
    this.controls.addEventListener('end', () => {
      this.moving = false;
      this.redraw();
    });
    this.controls.addEventListener('change', () => this.redraw());
    this.listen();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.resize();
    this.viewFrom('iso');
  }

  /** Colours of what is behind, of ghosts and of what is measured, for light or dark. */
  setTheme(background: string, ghost: string, ink: string): void {
    this.ink = new Color(ink).getHex();
    this.mark();
    this.renderer.setClearColor(new Color(background), 1);
    for (const material of Object.values(this.ghosts)) (material.uniforms.tint!.value as Color).set(ghost);
    this.redraw();
  }

  get others(): Others {
    return this.others_;
  }
  set others(value: Others) {
    this.others_ = value;
    this.redraw();
  }

  has(object: number): boolean {
    return itemsOf(this.items, object).length > 0;
  }

  /** Shows a clash, or none; the camera goes there unless it is told not to. */
  show(shown: Shown | undefined, fly = true): void {
    this.shown = shown;
    this.points = [];
    this.paint(shown ? [[shown.a, COLOUR_A], [shown.b, COLOUR_B]] : []);
    this.focus = shown ? this.local(shown.at) : undefined;
    this.mark();
    if (shown && fly) this.flyToShown();
    this.placeSection();
    this.redraw();
  }

  /** Shows one object. */
  showObject(object: number, fly: boolean): void {
    this.shown = undefined;
    this.paint([[object, COLOUR_PICKED]]);
    const box = objectBox(this.items, object);
    this.focus = box ? (box.min.map((v, k) => (v + box.max[k]!) / 2) as Vec) : undefined;
    this.mark();
    if (box && fly) this.goTo(this.focus!, Math.max(50, Math.hypot(...box.max.map((v, k) => v - box.min[k]!)) / 2) * 1.6);
    this.placeSection();
    this.redraw();
  }

  /** Shows the place of a group. */
  showBox(min: Vec, max: Vec): void {
    this.focus = this.local(min.map((v, k) => (v + max[k]!) / 2) as Vec);
    this.goTo(this.focus, Math.max(500, Math.hypot(...max.map((v, k) => v - min[k]!)) / 2 + 500));
    this.redraw();
  }

  flyToShown(): void {
    const { shown } = this;
    if (!shown || !this.focus) return this.fit();
    const sizes = [shown.a, shown.b].map((o) => objectBox(this.items, o)).filter((box) => box !== undefined)
      .map((box) => Math.hypot(...box.max.map((v, k) => v - box.min[k]!)));
    const arrow = shown.arrow ? Math.hypot(...shown.arrow.to.map((v, k) => v - shown.arrow!.from[k]!)) : 0;
    // The smaller of the two is seen whole, and of the larger the part that matters.
    const radius = Math.min(Math.max(60, 4 * arrow, 0.75 * Math.min(...sizes, 4000)), 3000);
    this.goTo(this.focus, radius);
  }

  /** The whole model. */
  fit(): void {
    const { bounds } = this.items;
    if (!Number.isFinite(bounds[0]!)) return;
    const size = new Vector3(...([0, 1, 2].map((k) => bounds[3 + k]! - bounds[k]!) as Vec));
    this.stand([0, 1, 2].map((k) => (bounds[k]! + bounds[3 + k]!) / 2) as Vec, Math.max(100, distanceForBox(this.camera, size)));
  }

  viewFrom(side: Side): void {
    const direction = new Vector3(...VIEW_DIRECTIONS[side]).normalize();
    const away = this.camera.position.distanceTo(this.controls.target) || distanceFor(this.camera, this.reach / 5);
    this.camera.position.copy(this.controls.target).addScaledVector(direction, -away);
    this.camera.lookAt(this.controls.target);
    this.controls.update();
    this.redraw();
  }

  zoom(factor: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.redraw();
  }

  turn(sideways: number, upwards: number): void {
    const away = this.camera.position.clone().sub(this.controls.target);
    const length = away.length();
    const angle = Math.atan2(away.y, away.x) + sideways;
    const height = Math.min(1.55, Math.max(-1.55, Math.asin(away.z / length) + upwards));
    away.set(Math.cos(angle) * Math.cos(height), Math.sin(angle) * Math.cos(height), Math.sin(height)).multiplyScalar(length);
    this.camera.position.copy(this.controls.target).add(away);
    this.camera.lookAt(this.controls.target);
    this.redraw();
  }

  /** Does in the middle of the picture what a click does. */
  pressMiddle(): void {
    this.press(this.width / 2, this.height / 2);
  }

  /** Moves sideways and upwards by shares of the picture. */
  move(sideways: number, upwards: number): void {
    const across = 2 * this.camera.position.distanceTo(this.controls.target) * Math.tan((this.camera.fov * Math.PI) / 360);
    this.camera.updateMatrixWorld();
    const [right, up] = [0, 1].map((column) => new Vector3().setFromMatrixColumn(this.camera.matrixWorld, column));
    const by = right!.multiplyScalar(sideways * across * this.camera.aspect).addScaledVector(up!, upwards * across);
    this.camera.position.add(by);
    this.controls.target.add(by);
    this.redraw();
  }

  /** A box round the clash outside of which nothing is shown; half its side in millimetres, or undefined for none. */
  section(half: number | undefined): void {
    this.sectionHalf = half;
    this.placeSection();
    this.mark();
    this.redraw();
  }

  /** Where a point of the model stands on the canvas in pixels, or undefined behind the camera. */
  project(point: Vec): { x: number; y: number } | undefined {
    this.camera.updateMatrixWorld();
    const p = new Vector3(...this.local(point)).project(this.camera);
    if (p.z > 1 || p.z < -1) return undefined;
    return { x: ((p.x + 1) / 2) * this.width, y: ((1 - p.y) / 2) * this.height };
  }

  clearMeasure(): void {
    this.points = [];
    this.mark();
    this.redraw();
    this.events.measured([]);
  }

  /** What is at a place of the canvas. */
  at(x: number, y: number): Hit | undefined {
    this.camera.updateMatrixWorld();
    const from = this.camera.position.toArray() as Vec;
    const through = new Vector3((x / this.width) * 2 - 1, 1 - (y / this.height) * 2, 0.5).unproject(this.camera);
    const along = through.sub(this.camera.position).normalize().toArray() as Vec;
    const ray: Ray = { from, along };
    const chosen = new Set(this.highlighted);
    const slack = (PIXELS_BESIDE * 2 * Math.tan((this.camera.fov * Math.PI) / 360)) / this.height;
    const limits: Limits = { slack, min: this.shared.sectionMin.value.toArray() as Vec, max: this.shared.sectionMax.value.toArray() as Vec };
    // One reaches through ghosts for the objects of the clash, and through nothing else.
    if (chosen.size > 0 && this.others_ !== 'solid') {
      const hit = pick(this.items, ray, { ...limits, visible: (object) => chosen.has(object) });
      if (hit || this.others_ === 'hide') return hit;
    }
    return pick(this.items, ray, limits);
  }

  redraw(): void {
    this.dirty = true;
    clearTimeout(this.pause);
    this.pause = undefined;
    this.schedule();
  }

  /** Whether everything in view has been drawn. */
  get settled(): boolean {
    return !this.scheduled && this.pause === undefined && this.queue.length === 0;
  }

  private local(point: Vec): Vec {
    return point.map((v, k) => v - this.origin[k]!) as Vec;
  }

  private paint(chosen: [number, number][]): void {
    this.highlighted = chosen.map(([object]) => object);
    // They are drawn apart, in their colours; in their batches they are left out.
    this.shared.apart.value.set(this.highlighted[0] ?? NOTHING, this.highlighted[1] ?? NOTHING);
    for (const child of this.pair.children as Mesh[]) child.geometry.dispose();
    this.pair.clear();
    this.hiddenPair.clear();
    for (const [object, colour] of chosen) {
      const list = itemsOf(this.items, object);
      if (list.length === 0) continue;
      const lines = list.filter((item) => isLine(this.items, item));
      if (lines.length > 0) this.paintLines(lines, this.paintOf(colour));
      if (lines.length === list.length) continue;
      const mesh = meshOf(this.items, list.filter((item) => !isLine(this.items, item)));
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(mesh.position, 3));
      geometry.setIndex(new BufferAttribute(mesh.index, 1));
      const paint = this.paintOf(colour);
      const body = new Mesh(geometry, paint.body);
      body.frustumCulled = false;
      this.pair.add(body);
      const behind = new Mesh(geometry, paint.behind);
      behind.frustumCulled = false;
      this.hiddenPair.add(behind);
      if (mesh.index.length < MAX_OUTLINED) {
        const outline = new BufferGeometry();
        outline.setAttribute('position', new BufferAttribute(sharpEdges(mesh, 30), 3));
        const rim = new LineSegments(outline, paint.rim);
        rim.frustumCulled = false;
        this.pair.add(rim);
      }
    }
  }

  private paintLines(lines: Uint32Array, paint: Paint): void {
    const geometry = new BufferGeometry();
    // Software rendering leaves out a line that begins behind the camera, as one through a clash does: it is drawn in pieces.
    geometry.setAttribute('position', new BufferAttribute(linePieces(meshOf(this.items, lines), 200), 3));
    for (const [scene, material] of [[this.pair, paint.line], [this.hiddenPair, paint.lineBehind]] as const) {
      const drawn = new LineSegments(geometry, material);
      drawn.frustumCulled = false;
      scene.add(drawn);
    }
  }

  /** A colour's materials are made once: a new one costs more than drawing with it. */
  private paintOf(colour: number): Paint {
    let paint = this.paints.get(colour);
    if (!paint) {
      paint = {
        body: makeMaterial(this.shared, { colour }),
        behind: makeMaterial(this.shared, { colour, behind: true }),
        line: makeMaterial(this.shared, { colour, lines: true }),
        lineBehind: makeMaterial(this.shared, { colour, lines: true, behind: true }),
        rim: makeMaterial(this.shared, { colour: new Color(colour).multiplyScalar(0.45).getHex(), lines: true }),
      };
      this.paints.set(colour, paint);
    }
    return paint;
  }

  private placeSection(): void {
    const { sectionMin, sectionMax } = this.shared;
    if (this.sectionHalf === undefined || !this.focus) {
      sectionMin.value.setScalar(-FAR);
      sectionMax.value.setScalar(FAR);
      return;
    }
    sectionMin.value.set(...this.focus).subScalar(this.sectionHalf);
    sectionMax.value.set(...this.focus).addScalar(this.sectionHalf);
  }

  /** The arrow of the depth, the section box and what is measured: over everything. */
  private mark(): void {
    const { marks } = this;
    marks.clear();
    if (this.shown && this.focus) {
      marks.dot(this.focus, COLOUR_MARK);
      const arrow = this.shown.arrow;
      if (arrow) {
        const [from, to] = [this.local(arrow.from), this.local(arrow.to)];
        marks.line([from, to], COLOUR_MARK);
        if (arrow.depth) marks.head(from, to, COLOUR_MARK);
        else for (const end of [from, to]) marks.dot(end, COLOUR_MARK);
      }
    }
    if (this.sectionHalf !== undefined && this.focus) {
      const [least, most] = [-1, 1].map((side) => this.focus!.map((v) => v + side * this.sectionHalf!) as Vec);
      marks.box(least!, most!, COLOUR_SECTION);
    }
    for (const point of this.points) marks.dot(point, this.ink);
    if (this.points.length === 2) marks.line(this.points, this.ink);
  }

  private goTo(target: Vec, radius: number): void {
    this.stand(target, distanceFor(this.camera, radius));
  }

  /** Looks at a place from so far away, in the direction in which it looks already. */
  private stand(target: Vec, away: number): void {
    const direction = this.camera.getWorldDirection(new Vector3());
    this.controls.target.set(...target);
    this.camera.position.copy(this.controls.target).addScaledVector(direction, -away);
    this.controls.update();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement!;
    this.visible = width > 0 && height > 0;
    if (!this.visible) return;
    // Asking the page for it while a picture is made would have it laid out each time.
    [this.width, this.height] = [width, height];
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.redraw();
  }

  private schedule(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => this.frame());
  }

  /** Draws a picture anew, or goes on with one. */
  private frame(): void {
    this.scheduled = false;
    // Nobody looks: the picture is made when the panel is shown, which tells its size.
    if (!this.visible) return;
    const anew = this.dirty;
    if (anew) {
      this.dirty = false;
      this.begin();
    }
    if (anew || !this.busy()) this.piece();
    if (this.queue.length > 0 && !this.moving) {
      if (anew && this.software) this.pause = setTimeout(() => this.goOn(), BREATH_MS);
      else this.schedule();
    }
    this.events.drawn();
  }

  private goOn(): void {
    this.pause = undefined;
    this.schedule();
  }

  /** Whether the last piece is still being drawn. */
  private busy(): boolean {
    if (!this.fence) return false;
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    if (!gl.isContextLost() && gl.getSyncParameter(this.fence, gl.SYNC_STATUS) !== gl.SIGNALED) return true;
    gl.deleteSync(this.fence);
    this.fence = undefined;
    return false;
  }

  private begin(): void {
    this.fresh = true;
    setDepth(this.camera, this.controls.target, this.reach);
    this.camera.updateMatrixWorld();
    this.renderer.clear();
    // Ghosts are of use near what one looks at; those of a whole ship are a fog.
    const across = this.camera.position.distanceTo(this.controls.target) * Math.tan((this.camera.fov * Math.PI) / 360);
    this.shared.fade.value = this.software ? Math.max(800, 1.3 * across) : Math.max(1200, 2 * across);
    this.shared.focus.value.set(...(this.focus ?? (this.controls.target.toArray() as Vec)));
    this.renderer.render(this.pair, this.camera);
    this.queue = this.others_ === 'hide' && this.highlighted.length > 0 ? [] : this.inView();
  }

  /** Batches that can be seen, the nearest to the clash last: they are taken from the end. */
  private inView(): Batch[] {
    const frustum = new Frustum().setFromProjectionMatrix(new Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse));
    const { sectionMin, sectionMax } = this.shared;
    const box = new Box3();
    const section = new Box3(sectionMin.value, sectionMax.value);
    const near = this.focus ?? (this.controls.target.toArray() as Vec);
    const order: { batch: Batch; distance: number }[] = [];
    const farthest = this.ghostly ? 1.5 * this.shared.fade.value : Infinity;
    for (const batch of this.batches) {
      box.min.fromArray(batch.box, 0);
      box.max.fromArray(batch.box, 3);
      if (!frustum.intersectsBox(box) || !section.intersectsBox(box)) continue;
      const distance = distanceTo(batch.box, near);
      if (distance < farthest) order.push({ batch, distance });
    }
    order.sort((p, q) => q.distance - p.distance);
    return order.map((o) => o.batch);
  }

  private get ghostly(): boolean {
    return this.others_ !== 'solid' && this.highlighted.length > 0;
  }

  private piece(): void {
    const materials = this.ghostly ? this.ghosts : this.solids;
    const started = performance.now();
    const meshes: Object3D[] = [];
    let left = !this.fresh ? this.budgets.next : this.moving ? this.budgets.moving : this.budgets.first;
    this.fresh = false;
    while (left > 0 && this.queue.length > 0) {
      const batch = this.queue.pop()!;
      meshes.push(this.gpu.mesh(batch, materials));
      left -= batch.triangles + 500;
      // A first picture is as well made of new buffers, which take longer than drawing them.
      if (performance.now() - started > 25) break;
    }
    if (meshes.length > 0) {
      this.pieces.children = meshes;
      this.renderer.render(this.pieces, this.camera);
      this.pieces.children = [];
      // No ghost stands before the two: those that were drawn over them are drawn over in turn.
      if (this.ghostly) this.renderer.render(this.pair, this.camera);
    }
    // One that lies within the other is seen through it. It blends, and so it is drawn once, over all others.
    if (this.queue.length === 0 || this.ghostly) this.renderer.render(this.hiddenPair, this.camera);
    this.marks.size(this.camera, this.height);
    this.renderer.render(this.marks.scene, this.camera);
    if (!this.software) return;
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    gl.deleteSync(this.fence ?? null);
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0) ?? undefined;
    gl.flush();
  }

  private listen(): void {
    let down: { x: number; y: number } | undefined;
    this.canvas.addEventListener('pointerdown', (e) => (down = { x: e.clientX, y: e.clientY }));
    this.canvas.addEventListener('pointerup', (e) => {
      const moved = down ? Math.hypot(e.clientX - down.x, e.clientY - down.y) : Infinity;
      down = undefined;
      if (moved > 4 || e.button !== 0) return;
      const frame = this.canvas.getBoundingClientRect();
      this.press(e.clientX - frame.left, e.clientY - frame.top);
    });
    this.canvas.addEventListener('wheel', (e) => e.preventDefault(), { passive: false });
    this.canvas.addEventListener('webglcontextlost', () => this.events.lost(true));
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.events.lost(false);
      this.redraw();
    });
  }

  /** What a click there does: an object is picked, or a point measured. */
  press(x: number, y: number): void {
    const hit = this.at(x, y);
    if (!this.measuring) return this.events.picked(hit?.object);
    if (!hit) return;
    if (this.points.length === 2) this.points = [];
    this.points.push(this.snap(hit, x, y));
    this.mark();
    this.redraw();
    this.events.measured(this.points.map((p) => p.map((v, k) => v + this.origin[k]!) as Vec));
  }

  /** A corner that is near enough on the screen is meant. */
  private snap(hit: Hit, x: number, y: number): Vec {
    let best = 12;
    let point = hit.point;
    for (const corner of hit.corners) {
      const p = this.project(corner.map((v, k) => v + this.origin[k]!) as Vec);
      const off = p ? Math.hypot(p.x - x, p.y - y) : Infinity;
      if (off < best) {
        best = off;
        point = corner;
      }
    }
    return point;
  }
}

