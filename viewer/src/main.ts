// SPDX-License-Identifier: Apache-2.0
import { decodeHead, HEAD_ID } from './payload/head.ts';
import { findBlock, unpackHead } from './payload/unpack.ts';

async function open(): Promise<void> {
  const head = decodeHead(await unpackHead(HEAD_ID, findBlock(HEAD_ID)));
  document.title = head.title;
}

void open();
