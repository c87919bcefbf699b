// SPDX-License-Identifier: Apache-2.0
// The form that sets status, assignee and comment of one clash or of many.
import { plural, STATUS_WORDS } from '../data/words.ts';
import { STATUSES } from '../payload/payload.ts';
import { fill, h } from '../ui/dom.ts';
import { ApiError, type Decision } from './api.ts';
import type { Decisions } from './decisions.ts';

/** What became of a decision: of how many clashes it is, and of which it is not. */
export interface Outcome {
  decided: number;
  refused: { row: number | undefined; what: string; why: string }[];
  /** there is more to see of the project than the page shows, as another run */
  isBehind: boolean;
}

const MAX_LISTED = 5;
type Field = 'status' | 'assignee' | 'comment';

export class DecideForm {
  readonly element: HTMLFormElement;
  private readonly status = h('select', { id: 'decide-status' });
  private readonly assignee = h('input', { id: 'decide-assignee', type: 'text', autocomplete: 'off', spellcheck: 'false' });
  private readonly comment = h('textarea', { id: 'decide-comment', rows: 2 });
  private readonly hint = h('p', { class: 'hint', id: 'decide-hint' });
  private readonly message = h('div', { class: 'decide-told', role: 'status' });
  private readonly save = h('button', { type: 'submit', class: 'small primary' }, 'Save');
  private readonly fields = [['status', this.status], ['assignee', this.assignee], ['comment', this.comment]] as const;
  private readonly touched = new Set<Field>();
  private rows: ArrayLike<number> = [];
  private busy = false;

  /** `decide` sends a decision about rows and throws an error whose message says why it could not; `nameOf` is how people call a row. */
  constructor(
    private readonly decisions: Decisions,
    by: string,
    private readonly decide: (rows: ArrayLike<number>, decision: Decision) => Promise<Outcome>,
    private readonly nameOf: (row: number) => string,
  ) {
    const field = (label: string, control: HTMLElement): HTMLElement => h('div', { class: 'decide-field' }, h('label', { for: control.id }, label), control);
    this.element = h('form', { class: 'decide', 'aria-label': 'Decision', 'aria-describedby': 'decide-hint' },
      field('Status', this.status), field('For', this.assignee), field('Comment', this.comment),
      h('div', { class: 'buttons' }, this.save, h('span', { class: 'hint' }, `as ${by}`)), this.hint, this.message);
    for (const [name, control] of this.fields) {
      control.addEventListener('input', () => {
        this.touched.add(name);
        fill(this.message);
        this.updateHint();
      });
    }
    // Letters that are typed here are none of the page's shortcuts.
    this.element.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && (event.ctrlKey || event.metaKey)) this.element.requestSubmit();
      if (event.key === 'Escape') (event.target as HTMLElement).blur();
      event.stopPropagation();
    });
    this.element.addEventListener('submit', (event) => {
      event.preventDefault();
      void this.submit();
    });
  }

  /** What is decided about from now on. */
  about(rows: ArrayLike<number>): void {
    this.rows = rows;
    this.touched.clear();
    fill(this.message);
    this.refresh();
  }

  /** Shows what rows say by now, but for what somebody is writing. */
  refresh(): void {
    if (this.rows.length === 0) return;
    if (!this.touched.has('status')) {
      const common = this.decisions.commonStatus(this.rows);
      fill(this.status, common === undefined && h('option', { value: '' }, this.rows.length > 1 ? 'as they are' : 'none'), ...STATUS_WORDS.map((word, s) => h('option', { value: STATUSES[s] }, word)));
      this.status.value = common === undefined ? '' : STATUSES[common]!;
    }
    for (const name of ['assignee', 'comment'] as const) {
      if (this.touched.has(name)) continue;
      const common = this.decisions.common(name, this.rows);
      this[name].value = common ?? '';
      this[name].placeholder = common === undefined ? 'as they are' : '';
    }
    this.updateHint();
  }

  /** What is to be set: what was touched and is another one now. */
  private decision(): Decision {
    const decision: Decision = {};
    const common = this.decisions.commonStatus(this.rows);
    const status = this.status.value;
    if (this.touched.has('status') && status !== '' && status !== (common === undefined ? '' : STATUSES[common])) decision.status = status;
    for (const name of ['assignee', 'comment'] as const) {
      if (this.touched.has(name) && this[name].value !== this.decisions.common(name, this.rows)) decision[name] = this[name].value;
    }
    return decision;
  }

  private updateHint(): void {
    const { assignee, comment } = this.decision();
    const words = [this.rows.length > 1 && `About ${plural(this.rows.length, 'clash', 'clashes')}.`, assignee === '' && 'Nobody sees to it from now on.', comment === '' && 'The comment is taken back.'];
    this.hint.textContent = words.filter(Boolean).join(' ');
  }

  private async submit(): Promise<void> {
    if (this.busy) {
      fill(this.message, h('p', {}, 'What was saved before is still on its way: save this in a moment.'));
      return;
    }
    const decision = this.decision();
    if (Object.keys(decision).length === 0) {
      fill(this.message, h('p', {}, 'Nothing is changed: choose another status, or write something.'));
      return;
    }
    this.busy = true;
    this.save.setAttribute('aria-disabled', 'true');
    const { rows } = this;
    const sent = this.fields.map(([, control]) => control.value);
    try {
      const outcome = await this.decide(rows, decision);
      if (this.rows === rows) this.showOutcome(outcome, sent);
      else if (outcome.refused.length > 0) this.showRefused(outcome, '');
    } catch (error) {
      const what = this.rows === rows ? '' : ` for ${rows.length === 1 ? this.nameOf(rows[0]!) : plural(rows.length, 'clash', 'clashes')}, chosen before`;
      // Who does not answer may have taken it all the same.
      const saved = error instanceof ApiError && error.kind === 'silent' ? 'It is not known whether it was saved' : 'Nothing was saved';
      fill(this.message, h('p', { class: 'note', role: 'alert' }, `${saved}${what}. ${error instanceof Error ? error.message : String(error)}`));
    }
    this.busy = false;
    this.save.removeAttribute('aria-disabled');
  }

  /** Tells what became of a decision about the rows that the form is about; `sent` is what its fields said then. */
  private showOutcome(outcome: Outcome, sent: readonly string[]): void {
    const { decided, refused, isBehind } = outcome;
    if (refused.length === 0) {
      // What was written since is still to be saved.
      this.fields.forEach(([name, control], i) => control.value === sent[i] && this.touched.delete(name));
      this.refresh();
      fill(this.message, h('p', {}, `Saved for ${plural(decided, 'clash', 'clashes')}.`));
      return;
    }
    // Who looks at what it says now, and still means it, saves again.
    this.rows = Uint32Array.from(refused.flatMap((r) => (r.row === undefined ? [] : [r.row])));
    this.refresh();
    const again = isBehind ? ' It shows what they say now; what a later run found is decided about once its results are shown.' : ' It shows what they say now; Save sets it all the same.';
    this.showRefused(outcome, this.rows.length > 0 ? again : '');
  }

  /** Whoever has gone on to another clash is told, too: what they decided is not saved. */
  private showRefused({ decided, refused }: Outcome, again: string): void {
    const saved = decided > 0 ? `Saved for ${plural(decided, 'clash', 'clashes')}.` : '';
    fill(this.message,
      h('div', { class: 'note', role: 'alert' },
        h('p', {}, `${saved} Not saved for ${plural(refused.length, 'clash that', 'clashes that')} changed meanwhile.${again}`.trim()),
        h('ul', {}, ...refused.slice(0, MAX_LISTED).map((r) => h('li', {}, `${r.what}: ${r.why}`)), refused.length > MAX_LISTED && h('li', {}, `and ${refused.length - MAX_LISTED} more`))));
  }
}
