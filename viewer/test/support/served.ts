// SPDX-License-Identifier: Apache-2.0
// The program serving a project of its own, for pages that ask a server.
import { type ChildProcess, execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/** The program, which builds of the project name to the tests. */
export const PROGRAM = process.env.STRAKE_PROGRAM;

export class ServedProject {
  readonly folder = mkdtempSync(join(tmpdir(), 'strake-view-'));
  private process: ChildProcess | undefined;

  constructor() {
    this.run('generate', 'ship', '--objects', '300', '--seed', '1', '-o', 'ship.glb');
    this.run('project', 'new', 'ship.strake', 'ship.glb');
    this.run('clash', '-p', 'ship.strake', '--clearance', '25mm', '--group-by', 'element');
  }

  run(...words: string[]): string {
    return execFileSync(PROGRAM!, words, { cwd: this.folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
  }

  /** What the project says of a clash: status, assignee and comment. */
  clash(key: string): { status: string; assignee: string; comment: string } {
    const listed = JSON.parse(this.run('clash', 'list', '-p', 'ship.strake', '--json')) as { clashes: Record<string, string>[] };
    const found = listed.clashes.find((c) => c.key === key)!;
    return { status: found.status!, assignee: found.assignee ?? '', comment: found.comment ?? '' };
  }

  /** Starts to serve, and gives the address. */
  async serve(): Promise<string> {
    const child = spawn(PROGRAM!, ['view', '-p', 'ship.strake', '--by', 'Ann'], { cwd: this.folder, stdio: ['ignore', 'pipe', 'inherit'] });
    this.process = child;
    return new Promise((done, fail) => {
      let told = '';
      child.stdout!.on('data', (piece: Buffer) => {
        told += piece.toString();
        if (told.includes('\n')) done(told.trim());
      });
      child.on('exit', (code) => fail(new Error(`strake view ended with ${code}`)));
    });
  }

  async stop(): Promise<number | null> {
    const child = this.process;
    this.process = undefined;
    if (!child || child.exitCode !== null) return child?.exitCode ?? null;
    const ended = new Promise<number | null>((done) => child.on('exit', done));
    child.kill('SIGINT');
    return ended;
  }

  async remove(): Promise<void> {
    await this.stop();
    rmSync(this.folder, { recursive: true });
  }
}
