// SPDX-License-Identifier: Apache-2.0
// Pens and colours of a drawing: the rules of its style sheet that say how lines and texts look, made anew.

const SELECTOR = /^[\w\s.-]+$/;
const VALUE = /^[#\w\s.,%-]*$/;
const NUMBER = String.raw`\d+(?:\.\d+)?`;
const PROPERTIES: Record<string, RegExp> = {
  fill: VALUE,
  stroke: VALUE,
  'stroke-width': new RegExp(`^${NUMBER}$`),
  'stroke-dasharray': new RegExp(`^(none|${NUMBER}(\\s+${NUMBER})*)$`),
  'stroke-linecap': /^(butt|round|square)$/,
  'stroke-linejoin': /^(miter|round|bevel)$/,
  'font-size': new RegExp(`^${NUMBER}px$`),
  'font-family': /^sans-serif$/,
};

/** The rules of all style elements of a drawing, for what lies within `scope`. What is not known is left out. */
export function styleRules(svg: string, scope: string): string {
  const rules: string[] = [];
  for (const [, text] of svg.matchAll(/<style>([^<]*)<\/style>/g)) {
    for (const [, selectors, body] of text!.matchAll(/([^{}]+)\{([^{}]*)\}/g)) {
      const kept = selectors!.split(',').map((one) => one.trim()).filter((one) => SELECTOR.test(one)).map((one) => `${scope} ${one}`);
      const declarations = body!.split(';').map((one) => one.trim()).filter((one) => {
        const colon = one.indexOf(':');
        const name = one.slice(0, colon).trim();
        return colon > 0 && Object.hasOwn(PROPERTIES, name) && PROPERTIES[name]!.test(one.slice(colon + 1).trim());
      });
      if (kept.length > 0 && declarations.length > 0) rules.push(`${kept.join(', ')} { ${declarations.join('; ')} }`);
    }
  }
  return rules.join('\n');
}

/** Puts rules behind those of the page. A browser that cannot do so draws as the page says. */
export function adopt(rules: string): void {
  if (rules === '' || !('adoptedStyleSheets' in document)) return;
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(rules);
  document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];
}
