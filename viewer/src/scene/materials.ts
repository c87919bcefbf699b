// SPDX-License-Identifier: Apache-2.0
import {
  Color, DataTexture, DoubleSide, GLSL3, GreaterDepth, LessEqualDepth, NearestFilter, RGBAFormat, ShaderMaterial, UnsignedByteType, Vector2, Vector3,
} from 'three';

/** What the program of the graphics card is told; one for all batches. */
export interface SharedUniforms {
  states: { value: DataTexture };
  /** objects that are drawn apart, and so left out of their batches; NOTHING: none */
  apart: { value: Vector2 };
  sectionMin: { value: Vector3 };
  sectionMax: { value: Vector3 };
  /** ghosts fade away with the distance from here */
  focus: { value: Vector3 };
  fade: { value: number };
}

const STATES_IN_ROW = 2048;

/** The number of no object. */
export const NOTHING = -1;

/** One texel for each object: its colour. What a click changes is not in it: of a million objects it is four megabytes. */
export class ObjectColours {
  readonly texture: DataTexture;
  private readonly bytes: Uint8Array<ArrayBuffer>;

  constructor(count: number) {
    const rows = Math.max(1, Math.ceil(count / STATES_IN_ROW));
    this.bytes = new Uint8Array(4 * STATES_IN_ROW * rows);
    this.texture = new DataTexture(this.bytes, STATES_IN_ROW, rows, RGBAFormat, UnsignedByteType);
    this.texture.minFilter = NearestFilter;
    this.texture.magFilter = NearestFilter;
    this.texture.needsUpdate = true;
  }

  set(object: number, rgb: number): void {
    this.bytes[4 * object] = (rgb >> 16) & 255;
    this.bytes[4 * object + 1] = (rgb >> 8) & 255;
    this.bytes[4 * object + 2] = rgb & 255;
  }
}

const VERTEX = `
#ifdef INSTANCED
in vec4 row0;
in vec4 row1;
in vec4 row2;
#endif
#ifndef ONE_COLOUR
in highp uint object;
uniform sampler2D states;
uniform ivec2 apart;
flat out vec3 shade;
#endif
out vec3 place;
out vec3 viewPosition;
void main() {
#ifdef INSTANCED
  vec4 p = vec4(position, 1.0);
  place = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
#else
  place = position;
#endif
  vec4 view = viewMatrix * vec4(place, 1.0);
  viewPosition = view.xyz;
  gl_Position = projectionMatrix * view;
#ifndef ONE_COLOUR
  shade = texelFetch(states, ivec2(int(object % ${STATES_IN_ROW}u), int(object / ${STATES_IN_ROW}u)), 0).rgb;
  if (int(object) == apart.x || int(object) == apart.y) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
#endif
}`;

const FRAGMENT = `
precision highp float;
uniform vec3 sectionMin;
uniform vec3 sectionMax;
uniform float opacity;
uniform vec3 tint;
uniform float tinted;
uniform vec3 focus;
uniform float fade;
#ifndef ONE_COLOUR
flat in vec3 shade;
#endif
in vec3 place;
in vec3 viewPosition;
out vec4 colour;
void main() {
  if (any(lessThan(place, sectionMin)) || any(greaterThan(place, sectionMax))) discard;
#ifdef ONE_COLOUR
  vec3 base = tint;
#else
  vec3 base = mix(shade, tint, tinted);
#endif
#ifdef GHOST
  float near = clamp(1.5 - distance(place, focus) / fade, 0.0, 1.0);
  if (near == 0.0) discard;
#endif
#ifdef LINES
  // A line has no face that light could fall on, and as a ghost it is seen edge-on from everywhere.
#ifdef GHOST
  colour = vec4(base, 4.0 * opacity * near);
#else
  colour = vec4(base, opacity);
#endif
  return;
#endif
  vec3 normal = normalize(cross(dFdx(viewPosition), dFdy(viewPosition)));
  float facing = abs(dot(normal, normalize(viewPosition)));
  float light = 0.66 + 0.28 * facing + 0.1 * normal.y;
#ifdef GHOST
  // Seen edge-on a ghost is denser, so that its outline shows.
  colour = vec4(base, opacity * near * mix(2.4, 0.75, facing));
#else
  colour = vec4(base * light, opacity);
#endif
}`;

export interface MaterialOptions {
  instanced?: boolean;
  ghost?: boolean;
  colour?: number;
  lines?: boolean;
  /** only what something hides, and that faintly */
  behind?: boolean;
}

/** A material of batches, or of one colour. Flat faces: the normal is that of the triangle on the screen. */
export function makeMaterial(shared: SharedUniforms, options: MaterialOptions): ShaderMaterial {
  const defines: Record<string, string> = {};
  if (options.instanced) defines.INSTANCED = '';
  if (options.ghost) defines.GHOST = '';
  if (options.colour !== undefined) defines.ONE_COLOUR = '';
  if (options.lines) defines.LINES = '';
  return new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    defines,
    side: DoubleSide,
    transparent: options.ghost || options.behind || false,
    depthWrite: !options.ghost && !options.behind,
    depthFunc: options.behind ? GreaterDepth : LessEqualDepth,
    uniforms: {
      states: shared.states,
      apart: shared.apart,
      sectionMin: shared.sectionMin,
      sectionMax: shared.sectionMax,
      focus: shared.focus,
      fade: shared.fade,
      // A line in a pipe covers next to nothing of it, and has to be seen.
      opacity: { value: options.ghost ? 0.08 : options.behind && !options.lines ? 0.65 : 1 },
      tint: { value: new Color(options.colour ?? 0x888888) },
      tinted: { value: options.ghost ? 1 : 0 },
    },
  });
}
