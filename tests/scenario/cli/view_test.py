#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""view_test.py STRAKE: a project looked at in a browser, and decided about there, as any program could do it."""
import http.client
import json
import re
import select
import signal
import socket
import sqlite3
import subprocess
import threading
import time
from contextlib import contextmanager

from scenario import Scenario, cube, main


class View(Scenario):
    """The server of a project of two clashes; `served` starts it and ends it."""

    def setUp(self):
        super().setUp()
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100) + cube('a1', 1, (50, 50, 50), 100)
                   + cube('a2', 2, (900, 0, 0), 100) + cube('a3', 3, (950, 50, 50), 100))
        self.text('project', 'new', 'p.strake', 'a.obj')
        self.text('clash', '-p', 'p.strake', '-o', 'r.json')
        results = json.loads((self.folder / 'r.json').read_text())['results']
        self.keys = [result['key'] for result in results]
        self.assertEqual(len(self.keys), 2)

    def start(self, *options):
        return subprocess.Popen([self.STRAKE, 'view', '-p', 'p.strake', *options], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    @contextmanager
    def served(self, *options):
        process = self.start('--by', 'Ann', *options)
        try:
            ready, _, _ = select.select([process.stdout], [], [], 60)
            self.assertTrue(ready, 'no address after a minute')
            address = process.stdout.readline().strip()
            match = re.fullmatch(r'http://127\.0\.0\.1:(\d+)/\?token=([0-9a-f]{40})', address)
            self.assertIsNotNone(match, f'{address} {process.poll()}')
            self.port, self.token = int(match[1]), match[2]
            yield process
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)

    def request(self, method, path, body=None, **changed):
        """The answer, with its body as text; a header that is None is left out."""
        headers = {'Host': f'127.0.0.1:{self.port}', 'Strake-Token': self.token,
                   **{name.replace('_', '-'): value for name, value in changed.items()}}
        if method == 'POST':
            headers.setdefault('Origin', f'http://127.0.0.1:{self.port}')
            headers.setdefault('Content-Type', 'application/json')
        connection = http.client.HTTPConnection('127.0.0.1', self.port, timeout=60)
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in headers.items():
            if value is not None:
                connection.putheader(name, value)
        data = b'' if body is None else body.encode()
        if method == 'POST':
            connection.putheader('Content-Length', str(len(data)))
        connection.endheaders(data or None)
        answer = connection.getresponse()
        answer.text = answer.read().decode()
        connection.close()
        return answer

    def decide(self, keys, run=1, event=0, expect=200, **decision):
        answer = self.request('POST', '/api/decide', json.dumps({'run': run, 'event': event, 'keys': keys, **decision}))
        self.assertEqual(answer.status, expect, answer.text)
        return json.loads(answer.text)

    def statuses(self):
        with sqlite3.connect(self.folder / 'p.strake') as project:
            return dict(project.execute('SELECT key, status FROM clashes'))

    def test_the_page_is_that_of_the_report_and_may_ask_its_server_alone(self):
        self.text('report', '-p', 'p.strake', '-o', 'r.html')
        with self.served():
            page = self.request('GET', f'/?token={self.token}', Strake_Token=None)
            self.assertEqual(page.status, 200)
            self.assertEqual(page.getheader('Content-Type'), 'text/html; charset=utf-8')
            self.assertEqual(page.getheader('Cache-Control'), 'no-store')
            self.assertEqual(page.getheader('X-Content-Type-Options'), 'nosniff')
            policy = page.getheader('Content-Security-Policy')
            self.assertIn("connect-src 'self'", policy)
            self.assertIn("frame-ancestors 'none'", policy)
            # The policy in the page says the same, or the two together let less through than each.
            self.assertIn(policy.removesuffix("; frame-ancestors 'none'"), page.text)
            cookie = page.getheader('Set-Cookie')
            self.assertIn('HttpOnly; SameSite=Strict', cookie)
            self.assertNotIn(self.token, cookie)
            again = self.request('GET', '/', Strake_Token=None, Cookie=cookie.split(';')[0])
            self.assertEqual(again.text, page.text)
        # All but what says that it is served, and its head, is what the file has.
        report = (self.folder / 'r.html').read_text()
        self.assertNotIn('connect-src', report)
        script = re.compile(r'<script>.*</script>', re.DOTALL)
        self.assertEqual(script.search(page.text)[0], script.search(report)[0])

    def test_nothing_is_answered_without_the_token_or_to_others(self):
        with self.served():
            for path in ('/', '/api/state?event=0', '/api/decide', '/x', f'/api/state?event=0&token={self.token}'):
                self.assertEqual(self.request('GET', path, Strake_Token=None).status, 403, path)
            self.assertEqual(self.request('GET', '/api/state?event=0').status, 200)
            for host in ('evil.example', f'evil.example:{self.port}', '127.0.0.1', None):
                self.assertIn(self.request('GET', '/api/state?event=0', Host=host).status, (400, 403), host)
            for origin in ('http://evil.example', 'null', None):
                answer = self.request('POST', '/api/decide', '{}', Origin=origin)
                self.assertEqual(answer.status, 403, origin)
                self.assertIsNone(answer.getheader('Access-Control-Allow-Origin'))
            self.assertEqual(self.request('OPTIONS', '/api/decide', Origin='http://evil.example').status, 403)
            self.assertEqual(self.request('PUT', '/', Origin=f'http://127.0.0.1:{self.port}').status, 405)
            self.assertEqual(self.request('GET', '/../p.strake').status, 404)
            self.assertEqual(self.request('GET', '/%2e%2e/p.strake').status, 404)
            self.assertEqual(self.request('POST', '/api/decide', '{}', Content_Type='text/plain').status, 415)
        self.assertEqual(set(self.statuses().values()), {'new'})

    def test_other_addresses_of_the_machine_do_not_answer(self):
        with self.served():
            for address in ('127.0.0.2', '::1'):
                with self.assertRaises(OSError):
                    socket.create_connection((address, self.port), timeout=5).close()

    def test_decisions_are_those_of_clash_set(self):
        with self.served():
            done = self.decide(self.keys[:1], status='approved', comment='as agreed', assignee='Bob')
            self.assertEqual(done['changed'], 1)
            clash = {'key': self.keys[0], 'status': 'approved', 'by': 'Ann', 'assignee': 'Bob', 'comment': 'as agreed'}
            self.assertEqual({name: done['clashes'][0][name] for name in clash}, clash)
            self.decide(self.keys[:1], event=done['event'], comment='')
            unknown = self.decide(self.keys[1:] + ['none'], event=99, expect=409, status='reviewed')
            self.assertEqual([refused['key'] for refused in unknown['refused']], ['none'])
            for bad in ({'status': 'done'}, {}, {'status': 'new', 'x': 1}):
                self.decide(self.keys, expect=400, **bad)
        self.assertEqual(self.statuses(), {self.keys[0]: 'approved', self.keys[1]: 'reviewed'})
        # The same by the program alone leaves the same project.
        self.text('project', 'new', 'q.strake', 'a.obj')
        self.text('clash', '-p', 'q.strake')
        for words in ([self.keys[0], '--status', 'approved', '--comment', 'as agreed', '--assignee', 'Bob'],
                      [self.keys[0], '--comment', ''], [self.keys[1], '--status', 'reviewed']):
            self.text('clash', 'set', '-p', 'q.strake', '--by', 'Ann', *words)
        reported = []
        for name in ('p.strake', 'q.strake'):
            with sqlite3.connect(self.folder / name) as project:
                reported.append(project.execute('SELECT key, status, decided_by, comment, assignee, decided_d_mm FROM clashes '
                                            'ORDER BY key').fetchall()
                            + project.execute('SELECT clash, run, who, before, after, comment FROM event').fetchall())
        self.assertEqual(reported[0], reported[1])

    def test_what_others_do_meanwhile_is_noticed(self):
        with self.served():
            self.text('clash', 'set', '-p', 'p.strake', self.keys[0], '--status', 'reviewed', '--by', 'Bob')
            state = json.loads(self.request('GET', '/api/state?event=0').text)
            self.assertEqual([clash['status'] for clash in state['clashes']], ['reviewed'])
            done = self.decide(self.keys, expect=409, status='approved')
            self.assertEqual(done['refused'], [{'key': self.keys[0], 'why': 'Bob made it reviewed meanwhile'}])
            self.assertEqual(self.statuses(), {self.keys[0]: 'reviewed', self.keys[1]: 'approved'})
            before = self.request('GET', '/').text
            self.text('clash', '-p', 'p.strake')
            state = json.loads(self.request('GET', f"/api/state?event={done['event']}").text)
            self.assertEqual(state['run'], 2)
            self.assertNotEqual(self.request('GET', '/').text, before, 'the page is that of the new run')

    def test_what_a_later_run_measured_otherwise_is_not_approved_unseen(self):
        with self.served():
            self.write('a.obj', cube('a0', 0, (0, 0, 0), 100) + cube('a1', 1, (70, 70, 70), 100)
                       + cube('a2', 2, (900, 0, 0), 100) + cube('a3', 3, (950, 50, 50), 100))
            self.text('project', 'update', 'p.strake')
            self.text('clash', '-p', 'p.strake')
            event = json.loads(self.request('GET', '/api/state?event=0').text)['event']
            done = self.decide(self.keys, event=event, expect=409, status='approved')
            self.assertEqual([refused['why'] for refused in done['refused']], ['run 2 finds it otherwise: HIT, d = -30.000 mm'])
            self.assertEqual(sorted(self.statuses().values()), ['active', 'approved'])
            self.decide(self.keys, run=2, event=event + 1, status='approved')

    def test_a_project_that_is_locked_is_reported_and_served_on(self):
        with self.served():
            writer = sqlite3.connect(self.folder / 'p.strake', isolation_level=None)
            writer.execute('BEGIN IMMEDIATE')
            answer = self.request('POST', '/api/decide',
                              json.dumps({'run': 1, 'event': 0, 'keys': self.keys, 'status': 'approved'}))
            self.assertEqual(answer.status, 503)
            reported = json.loads(answer.text)
            alone = self.run_strake('clash', 'set', '-p', 'p.strake', self.keys[0], '--status', 'approved')
            self.assertIn(reported['error'].split(': ', 1)[1], alone.stderr)
            self.assertEqual(self.request('GET', '/').status, 200)
            writer.execute('ROLLBACK')
            writer.close()
            self.decide(self.keys, status='approved')

    def test_a_project_that_is_not_there_any_more_takes_no_decisions(self):
        with self.served():
            for move in (lambda: (self.folder / 'p.strake').rename(self.folder / 'away.strake'),
                         lambda: self.write('p.strake', 'another one')):
                move()
                reported = self.decide(self.keys, expect=503, status='approved')
                self.assertIn('was moved, deleted or replaced', reported['error'])
                self.assertEqual(self.request('GET', '/api/state?event=0').status, 503)
                page = self.request('GET', '/')
                self.assertEqual((page.status, page.getheader('Content-Type')), (503, 'text/plain; charset=utf-8'))
            (self.folder / 'away.strake').rename(self.folder / 'p.strake')
            self.decide(self.keys[:1], status='approved')
        self.assertEqual(self.statuses(), {self.keys[0]: 'approved', self.keys[1]: 'new'})

    def test_a_decision_that_waits_for_the_project_keeps_nobody_waiting(self):
        with self.served('--wait', '60'):
            other = sqlite3.connect(self.folder / 'p.strake', isolation_level=None)
            other.execute('BEGIN IMMEDIATE')
            done = []
            waits = threading.Thread(target=lambda: done.append(self.decide(self.keys[:1], status='approved')))
            waits.start()
            try:
                for _ in range(4):
                    time.sleep(.2)
                    self.assertEqual(self.request('GET', '/api/state?event=0').status, 200)
                    self.assertEqual(self.request('GET', '/', Strake_Token=self.token).status, 200)
                self.assertTrue(waits.is_alive())
            finally:
                other.execute('ROLLBACK')
                other.close()
                waits.join(60)
            self.assertEqual(done[0]['changed'], 1)
        with self.served('--wait', '1'):
            other = sqlite3.connect(self.folder / 'p.strake', isolation_level=None)
            other.execute('BEGIN IMMEDIATE')
            reported = self.request('POST', '/api/decide', json.dumps({'run': 1, 'event': 9, 'keys': self.keys, 'status': 'new'}))
            other.close()
            self.assertEqual(reported.status, 503, reported.text)
            self.assertIn('another program writes to the project', reported.text)
        self.assertEqual(self.statuses()[self.keys[0]], 'approved')

    def test_slow_and_broken_clients_keep_nobody_waiting(self):
        with self.served():
            slow = [socket.create_connection(('127.0.0.1', self.port)) for _ in range(30)]
            for client in slow:
                client.sendall(b'GET / HTTP/1.1\r\nHost: x\r\nX: ')
            for bad in (b'\x00' * 1000, b'GET /' + b'a' * 300000, b'POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n',
                        b'GET / HTTP/1.1\r\n' + b'X: y\r\n' * 50000):
                with socket.create_connection(('127.0.0.1', self.port)) as client:
                    try:
                        client.sendall(bad)
                    except OSError:
                        pass  # it was turned away before all of it was sent
            before = time.monotonic()
            self.assertEqual(self.request('GET', '/api/state?event=0').status, 200)
            self.assertLess(time.monotonic() - before, 10)
            for client in slow:
                client.close()

    def test_long_names_and_strange_ones_are_texts(self):
        name = '</script><b>"\\\u202e' + 'x' * 10000
        with self.served():
            done = self.decide(self.keys[:1], assignee=name, comment=name)
            self.assertEqual(done['clashes'][0]['assignee'], name)
            self.assertEqual(done['clashes'][0]['comment'], name)
            self.assertNotIn(name, self.request('GET', '/').text)

    def test_an_interruption_ends_it_well(self):
        for name in ('SIGINT', 'SIGTERM'):
            with self.served() as process:
                idle = socket.create_connection(('127.0.0.1', self.port))
                before = time.monotonic()
                process.send_signal(getattr(signal, name))
                process.communicate(timeout=60)
                self.assertEqual(process.returncode, 0, name)
                self.assertLess(time.monotonic() - before, 5)
                idle.close()

    def test_tokens_are_others_each_time_and_a_port_is_had_once(self):
        with self.served() as process:
            first, port = self.token, self.port
            second = self.run_strake('view', '-p', 'p.strake', '--port', port)
            self.assertEqual(second.returncode, 3)
            self.assertIn('in use', second.stderr)
            self.assertNotIn(first, second.stderr + second.stdout)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
        with self.served('--port', str(port)):
            self.assertEqual(self.port, port)
            self.assertNotEqual(self.token, first)
            self.assertEqual(self.request('GET', '/', Strake_Token=first).status, 403)

    def test_a_wrong_command_line_is_reported(self):
        for words, reported in ((['view'], 'no project is given'), (['view', '-p', 'p.strake', '--port', '70000'], 'there is no port'),
                            (['view', '-p', 'p.strake', '--port', 'x'], '--port')):
            done = self.run_strake(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(reported, done.stderr)
        self.assertEqual(self.run_strake('view', '-p', 'none.strake').returncode, 3)


if __name__ == '__main__':
    main()
