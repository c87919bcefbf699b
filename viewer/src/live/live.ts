// SPDX-License-Identifier: Apache-2.0
// A page that 'strake view' serves: it sets statuses, follows what others set, and says when there is another run.
import { objectName, type Report, shown } from '../data/report.ts';
import { fill, h } from '../ui/dom.ts';
import { Api, ApiError, type Decision, type ProjectState, takeToken } from './api.ts';
import { DecideForm, type Outcome } from './decide_form.ts';
import { Decisions } from './decisions.ts';
import { Marks, type MarkEvents } from './marks.ts';

export interface LiveEvents extends MarkEvents {
  /** decisions about rows are others now */
  decided(rows: readonly number[]): void;
}

const POLL_MS = 3000;
const SLOW_POLL_MS = 15000;
/** A request of this many keys stays below what the server takes. */
const KEYS_AT_ONCE = 200_000;

export class Live {
  /** What there is to say about the project as a whole. */
  readonly bar = h('div', { class: 'live-bar', role: 'status' });
  readonly marks: Marks | undefined;
  private readonly form: DecideForm | undefined;
  private readonly decisions: Decisions | undefined;
  private readonly api: Api | undefined;
  private readonly known: { run: number; event: number };
  private work: Promise<unknown> = Promise.resolve();
  private timer: ReturnType<typeof setTimeout> | undefined;
  private notice = '';
  private isPolling = false;

  /** Undefined for a page that is a file: it asks nobody anything. */
  static of(report: Report, events: LiveEvents): Live | undefined {
    return report.head.served && /^https?:$/.test(location.protocol) ? new Live(report, events) : undefined;
  }

  private constructor(
    private readonly report: Report,
    private readonly events: LiveEvents,
  ) {
    const { run, event, by } = report.head.served!;
    this.known = { run, event };
    document.documentElement.classList.add('live');
    if (report.results) this.decisions = new Decisions(report.results);
    const token = takeToken();
    if (token === undefined) {
      this.showNotice('To set statuses here, open the address that ‘strake view’ printed: it has the token for it.');
      return;
    }
    this.api = new Api(token);
    if (!this.decisions) return;
    this.marks = new Marks(events);
    this.form = new DecideForm(this.decisions, shown(by).slice(0, 80), (rows, decision) => this.decide(rows, decision), (row) => this.nameOf(row));
  }

  /** Begins to follow the project. */
  start(): void {
    if (!this.api) return;
    document.addEventListener('visibilitychange', () => this.poll());
    this.poll();
  }

  /** Adds to the help what a page that is a file does not have. */
  explain(help: HTMLElement): void {
    if (!this.form) return;
    help.append(
      h('h3', {}, 'Deciding'),
      h('p', {}, 'Set status, who sees to it and a comment of the chosen clash or group, and press Save or Ctrl+Enter. What is not touched stays as it is. Tick several rows, or press the space bar on the chosen one, and press Decide. What others set shows by itself. This page speaks with ‘strake view’ on this machine, and with nobody else.'));
  }

  /** Decisions are about these rows from now on. */
  about(rows: ArrayLike<number>): void {
    this.form?.about(rows);
  }

  /** Puts the form into details that are told of what it is about. */
  place(details: HTMLElement): void {
    if (!this.form) return;
    details.querySelector('.details-head')?.after(this.form.element);
  }

  /** Does what moves the form within the page, and leaves who writes in it where they are. */
  keepFocus(change: () => void): void {
    const focused = this.form?.element.contains(document.activeElement) ? (document.activeElement as HTMLElement) : undefined;
    change();
    focused?.focus();
  }

  private poll(): void {
    clearTimeout(this.timer);
    if (document.hidden || this.isPolling) return;
    this.isPolling = true;
    void this.inTurn(async () => this.take(await this.api!.state(this.known.event))).then(
      () => this.again(POLL_MS),
      (error: unknown) => {
        this.showError(error);
        this.again(SLOW_POLL_MS);
      },
    );
  }

  private again(after: number): void {
    this.isPolling = false;
    this.timer = setTimeout(() => this.poll(), after);
  }

  /** One question after another, so that no older answer is taken for a newer one. */
  private inTurn<T>(task: () => Promise<T>): Promise<T> {
    const done = this.work.then(task);
    this.work = done.catch(() => undefined);
    return done;
  }

  private take(state: ProjectState): void {
    // What is not told is not seen: it is asked for again, and not decided about, until the page is loaded anew.
    if (!state.tooMany) this.known.event = state.event;
    const rows = this.decisions?.apply(state.clashes) ?? [];
    if (rows.length > 0) {
      this.form?.refresh();
      this.events.decided(rows);
    }
    if (state.run !== this.known.run) this.showNotice(`Run ${state.run} has tested this project since this page was made.`, 'Show its results');
    else if (state.tooMany) this.showNotice('Much was decided since this page was made.', 'Show it');
    else this.showNotice('');
  }

  private async decide(rows: ArrayLike<number>, decision: Decision): Promise<Outcome> {
    const { key } = this.report.results!;
    const keys = Array.from(rows, (row) => key.at(row));
    // What was seen when somebody pressed Save, whatever is told before it is their turn.
    const known = { ...this.known };
    return this.inTurn(async () => {
      const outcome: Outcome = { decided: 0, refused: [], isBehind: false };
      for (let from = 0; from < keys.length; from += KEYS_AT_ONCE) {
        const part = keys.slice(from, from + KEYS_AT_ONCE);
        const state = await this.api!.decide(known, part, decision);
        this.take(state);
        outcome.decided += part.length - state.refused.length;
        outcome.isBehind ||= state.tooMany || state.run !== this.known.run;
        for (const { key: of, why } of state.refused) {
          const row = this.decisions!.row(of);
          outcome.refused.push({ row, what: row === undefined ? of : this.nameOf(row), why: shown(why.replace(/\s+/g, ' ')).slice(0, 300) });
        }
      }
      return outcome;
    });
  }

  /** A clash by its objects. */
  private nameOf(row: number): string {
    const { results, objects } = this.report;
    return [results!.a, results!.b].map((side) => objectName(objects!, side[row]!).slice(0, 60)).join(' and ');
  }

  private showError(error: unknown): void {
    if (!(error instanceof ApiError)) throw error;
    if (error.kind === 'unknown') this.showNotice('This page is of an earlier ‘strake view’: open the address that the one that runs now has printed.');
    else if (error.kind === 'silent') this.showNotice(`${error.message} It may have been ended: nothing can be set until it runs again.`);
    else this.showNotice(error.message);
  }

  /** Says something above all, once; with a button that loads the page anew. */
  private showNotice(words: string, button?: string): void {
    if (this.notice === words) return;
    this.notice = words;
    fill(this.bar, words !== '' && h('p', {}, words), button !== undefined && h('button', { type: 'button', class: 'small', onclick: () => location.reload() }, button));
  }
}
