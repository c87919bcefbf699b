// SPDX-License-Identifier: Apache-2.0

/** What is wrong with the payload, in words for whoever opened the page. */
export class PayloadError extends Error {
  constructor(
    readonly block: string,
    readonly what: string,
  ) {
    super(`${block}: ${what}`);
    this.name = 'PayloadError';
  }
}
