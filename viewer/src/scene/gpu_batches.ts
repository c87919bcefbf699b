// SPDX-License-Identifier: Apache-2.0
// Makes what the graphics card draws of a batch, when it is drawn for the first time.
import { BufferAttribute, BufferGeometry, InstancedBufferAttribute, InstancedBufferGeometry, LineSegments, Mesh, type ShaderMaterial } from 'three';
import { type Batch, BOXES, LINES, MERGED } from './batches.ts';
import { type Items, itemVertices, lineEnds, meshOf } from './items.ts';

export interface BatchMaterials {
  instanced: ShaderMaterial;
  merged: ShaderMaterial;
  lines: ShaderMaterial;
}

interface ShapeAttributes {
  position: BufferAttribute;
  index: BufferAttribute;
}

export class GpuBatches {
  private readonly meshes = new Map<Batch, Mesh | LineSegments>();
  private readonly shapes = new Map<number, ShapeAttributes>();

  constructor(private readonly items: Items) {}

  /** The mesh of a batch. Its material is set whenever it is drawn. */
  mesh(batch: Batch, materials: BatchMaterials): Mesh | LineSegments {
    let mesh = this.meshes.get(batch);
    if (!mesh) {
      if (batch.shape === LINES) mesh = new LineSegments(this.merged(batch));
      else mesh = new Mesh(batch.shape === MERGED ? this.merged(batch) : this.instanced(batch));
      mesh.frustumCulled = false;
      mesh.matrixAutoUpdate = false;
      this.meshes.set(batch, mesh);
    }
    mesh.material = batch.shape === LINES ? materials.lines : batch.shape === MERGED ? materials.merged : materials.instanced;
    return mesh;
  }

  private merged(batch: Batch): BufferGeometry {
    const mesh = meshOf(this.items, batch.items);
    const { position } = mesh;
    const object = new Uint32Array(position.length / 3);
    let at = 0;
    for (const item of batch.items) {
      const vertices = itemVertices(this.items, item);
      object.fill(this.items.object[item]!, at, at + vertices);
      at += vertices;
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(position, 3));
    geometry.setAttribute('object', new BufferAttribute(object, 1));
    geometry.setIndex(new BufferAttribute(batch.shape === LINES ? lineEnds(mesh) : mesh.index, 1));
    return geometry;
  }

  private instanced(batch: Batch): InstancedBufferGeometry {
    const { items } = this;
    const n = batch.items.length;
    const rows = [0, 1, 2].map(() => new Float32Array(4 * n));
    const object = new Uint32Array(n);
    batch.items.forEach((item, i) => {
      object[i] = items.object[item]!;
      for (let row = 0; row < 3; ++row) {
        if (batch.shape === BOXES) {
          const [low, high] = [items.box[6 * item + row]!, items.box[6 * item + 3 + row]!];
          rows[row]![4 * i + row] = high - low;
          rows[row]![4 * i + 3] = low;
        } else {
          rows[row]!.set(items.model.instances.matrix.subarray(12 * item + 4 * row, 12 * item + 4 * row + 4), 4 * i);
        }
      }
    });
    const geometry = new InstancedBufferGeometry();
    const shape = this.shape(batch.shape);
    geometry.setAttribute('position', shape.position);
    geometry.setIndex(shape.index);
    rows.forEach((row, k) => geometry.setAttribute(`row${k}`, new InstancedBufferAttribute(row, 4)));
    geometry.setAttribute('object', new InstancedBufferAttribute(object, 1));
    geometry.instanceCount = n;
    return geometry;
  }

  private shape(shape: number): ShapeAttributes {
    let made = this.shapes.get(shape);
    if (!made) {
      made = shape === BOXES ? unitBox() : this.ofShape(shape);
      this.shapes.set(shape, made);
    }
    return made;
  }

  private ofShape(s: number): ShapeAttributes {
    const { shapes } = this.items.model;
    const position = new Float32Array(3 * shapes.vertices[s]!);
    const step = shapes.step[s]!;
    for (let i = 0; i < position.length; ++i) position[i] = shapes.min[i % 3]![s]! + step * shapes.position[3 * shapes.firstVertex[s]! + i]!;
    const from = shapes.firstIndex[s]!;
    const index = shapes.index.slice(from, from + 3 * shapes.triangles[s]!);
    return { position: new BufferAttribute(position, 3), index: new BufferAttribute(index, 1) };
  }
}

function unitBox(): ShapeAttributes {
  const position = new Float32Array(24);
  for (let i = 0; i < 8; ++i) position.set([i & 1, (i >> 1) & 1, (i >> 2) & 1], 3 * i);
  const index = new Uint16Array([0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5]);
  return { position: new BufferAttribute(position, 3), index: new BufferAttribute(index, 1) };
}
